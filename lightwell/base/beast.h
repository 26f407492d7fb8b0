// SPDX-License-Identifier: Apache-2.0
#pragma once

// Boost's sockets and HTTP, under the names that the rooms `transport` and `server` use.

// Boost 1.74's asio uses std::exchange without including <utility>.
// clang-format off
#include <utility>
#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
// clang-format on

namespace lightwell {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using boost::system::error_code;

}  // namespace lightwell
