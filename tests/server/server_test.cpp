// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/server.h"

#include <fcntl.h>
#include <sys/resource.h>

#include "tests/server/running_server.h"

namespace lightwell {
namespace {

using namespace std::chrono_literals;

class ServerTest : public testing::Test {
 protected:
  ServerTest() {
    folder_.write("secret.glb", "outside");
    folder_.write("page/index.html", "<!doctype html>");
    folder_.write("page/core/lightwell.wasm", "wasm");
    folder_.write("page/main.js", "js");
    folder_.write("page/.hidden", "hidden");
    folder_.write("packs/room one.lw.glb", pack_);
    folder_.write("packs/notes.txt", "notes");
    std::filesystem::create_symlink(folder_.path() / "secret.glb", folder_.path() / "page/link.glb");
    options_.packs = {folder_.path() / "packs", folder_.write("single.glb", single_)};
    options_.page = folder_.path() / "page";
  }

  const std::string pack_ = pack_of(300000), single_ = pack_of(6);
  const std::string total_ = std::to_string(pack_.size());
  const std::string url_ = "/packs/room%20one.lw.glb";
  TemporaryFolder folder_;
  ServerOptions options_;
};

TEST_F(ServerTest, GivesThePageAndItsFiles) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  EXPECT_EQ(connection.get("/").body, "<!doctype html>");
  EXPECT_EQ(connection.get("/?x=1").fields["content-type"], "text/html; charset=utf-8");
  EXPECT_EQ(connection.get("/core/lightwell.wasm").fields["content-type"], "application/wasm");
  EXPECT_EQ(connection.get("/main.js").fields["content-type"], "text/javascript; charset=utf-8");
  EXPECT_EQ(connection.get("/healthz").body, "ok\n");
  EXPECT_EQ(connection.get("/absent").status, 404);
}

TEST_F(ServerTest, ListsPacks) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  const RawResponse list = connection.get("/packs.json");
  EXPECT_EQ(list.fields.at("content-type"), "application/json");
  EXPECT_EQ(list.body,
            "{\"packs\":[{\"name\":\"room one.lw.glb\",\"url\":\"/packs/room%20one.lw.glb\",\"bytes\":" + total_ +
                "},"
                "{\"name\":\"single.glb\",\"url\":\"/packs/single.glb\",\"bytes\":" +
                std::to_string(single_.size()) + "}]}\n");
  folder_.write("packs/a.glb", single_);
  EXPECT_NE(connection.get("/packs.json").body.find("a.glb"), std::string::npos);
  EXPECT_EQ(connection.get("/packs/a.glb").body, single_);
  folder_.write("packs/plain.glb", "glTF, but no pack");
  EXPECT_EQ(connection.get("/packs.json").body.find("plain.glb"), std::string::npos);
}

TEST_F(ServerTest, GivesRanges) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  const RawResponse whole = connection.get(url_);
  EXPECT_EQ(whole.status, 200);
  EXPECT_EQ(whole.body, pack_);
  EXPECT_EQ(whole.fields.at("content-type"), "model/gltf-binary");
  EXPECT_EQ(whole.fields.at("accept-ranges"), "bytes");
  EXPECT_EQ(whole.fields.at("access-control-allow-origin"), "*");
  EXPECT_EQ(whole.fields.at("access-control-expose-headers"), "Content-Range, ETag, Accept-Ranges");

  const RawResponse part = connection.get(url_, "Range: bytes=1000-1999\r\n");
  EXPECT_EQ(part.status, 206);
  EXPECT_EQ(part.body, pack_.substr(1000, 1000));
  EXPECT_EQ(part.fields.at("content-range"), "bytes 1000-1999/" + total_);
  EXPECT_EQ(connection.get(url_, "Range: bytes=-10\r\n").body, pack_.substr(pack_.size() - 10));
  EXPECT_EQ(connection.get(url_, "Range: bytes=" + std::to_string(pack_.size() - 10) + "-\r\n").body,
            pack_.substr(pack_.size() - 10));
  EXPECT_EQ(connection.get(url_, "Range: bytes=0-1,5-6\r\n").status, 200);
  const RawResponse beyond = connection.get(url_, "Range: bytes=" + total_ + "-\r\n");
  EXPECT_EQ(beyond.status, 416);
  EXPECT_EQ(beyond.fields.at("content-range"), "bytes */" + total_);
}

TEST_F(ServerTest, HeadHasNoBody) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  const RawResponse head = connection.get(url_, "", "HEAD");
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.fields.at("content-length"), total_);
  EXPECT_EQ(connection.get("/healthz").body, "ok\n") << "the next answer follows directly";
  for (const char* range : {"Range: bytes=0-9\r\n", "Range: bytes=99999999-\r\n"}) {
    const RawResponse whole = connection.get(url_, range, "HEAD");
    EXPECT_EQ(whole.status, 200) << "a range has a meaning for GET alone";
    EXPECT_EQ(whole.fields.at("content-length"), total_);
    EXPECT_EQ(whole.fields.count("content-range"), 0u);
  }
}

TEST_F(ServerTest, TagsTellAReplacedFile) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  const std::string before = connection.get(url_, "Range: bytes=0-9\r\n").fields.at("etag");
  EXPECT_EQ(before.front(), '"') << "a strong tag";
  EXPECT_EQ(connection.get(url_, "Range: bytes=0-9\r\nIf-Range: " + before + "\r\n").status, 206);
  EXPECT_EQ(connection.get(url_, "If-None-Match: " + before + "\r\n").status, 304);
  const std::string other = pack_of(300001);
  folder_.write("packs/new", other);
  std::filesystem::rename(folder_.path() / "packs/new", folder_.path() / "packs/room one.lw.glb");
  const RawResponse after = connection.get(url_, "Range: bytes=0-9\r\nIf-Range: " + before + "\r\n");
  EXPECT_EQ(after.status, 200);
  EXPECT_NE(after.fields.at("etag"), before);
  EXPECT_EQ(after.body, other);
}

TEST_F(ServerTest, GivesNothingFromOutside) {
  RunningServer server(options_);
  for (const char* target :
       {"/../secret.glb", "/%2e%2e/secret.glb", "/core/../../secret.glb", "/core/%2e%2e%2f%2e%2e%2fsecret.glb",
        "//secret.glb", "/.hidden", "/link.glb", "/packs/../secret.glb", "/packs/..%2fsecret.glb", "/packs/notes.txt",
        "/packs/", "/packs", "/core", "/core/", "/main.js%00.glb", "/packs/%2fetc%2fpasswd", "/%zz", "/%2",
        "/core\\..\\main.js"}) {
    RawConnection connection(server.port());
    EXPECT_EQ(connection.get(target).status, 404) << target;
  }
  RawConnection connection(server.port());
  EXPECT_EQ(connection.get("secret.glb").status / 100, 4) << "a target without its slash";
}

TEST_F(ServerTest, RefusesOtherMethodsAndBodies) {
  RunningServer server(options_);
  RawConnection post(server.port());
  const RawResponse refused = post.get("/", "Content-Length: 3\r\n", "POST");
  EXPECT_EQ(refused.status, 405);
  EXPECT_EQ(refused.fields.at("allow"), "GET, HEAD, OPTIONS");
  RawConnection preflight(server.port());
  const RawResponse allowed = preflight.get("/packs.json", "Access-Control-Request-Headers: range\r\n", "OPTIONS");
  EXPECT_EQ(allowed.status, 204);
  EXPECT_EQ(allowed.fields.at("access-control-allow-headers"), "Range, If-Range, If-None-Match");
}

TEST_F(ServerTest, RefusesLongAndBrokenHeaders) {
  RunningServer server(options_);
  RawConnection fat(server.port());
  EXPECT_EQ(fat.get("/", "X: " + std::string(20000, 'x') + "\r\n").status, 431);
  RawConnection broken(server.port());
  broken.send("GARBAGE\r\n\r\n");
  EXPECT_EQ(broken.receive().status, 400);
  EXPECT_TRUE(broken.ended());
}

TEST_F(ServerTest, UnderstandsATargetInAbsoluteForm) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  EXPECT_EQ(connection.get("http://example.org/packs/single.glb").body, single_);
  EXPECT_EQ(connection.get("HTTP://example.org:80" + url_ + "?x=://").body, pack_);
  EXPECT_EQ(connection.get("http://example.org").body, "<!doctype html>");
  EXPECT_EQ(connection.get("http://example.org?x=/secret").body, "<!doctype html>");
  EXPECT_EQ(connection.get("http://example.org/../secret.glb").status, 404);
  EXPECT_EQ(connection.get("/http://example.org/main.js").status, 404);
}

TEST_F(ServerTest, WantsOneHost) {
  RunningServer server(options_);
  for (const char* hosts : {"", "Host: a\r\nHost: a\r\n", "Host: a\r\nX: y\r\nhost: b\r\n"}) {
    RawConnection connection(server.port());
    connection.send("GET /healthz HTTP/1.1\r\n" + std::string(hosts) + "\r\n");
    EXPECT_EQ(connection.receive().status, 400) << hosts;
    EXPECT_TRUE(connection.ended()) << "who writes two hosts may mean two requests";
  }
  RawConnection old(server.port());
  old.send("GET /healthz HTTP/1.0\r\n\r\n");
  EXPECT_EQ(old.receive().status, 200);
}

/// Takes all descriptors that the process may have, but for those in use.
class NoDescriptorsLeft {
 public:
  NoDescriptorsLeft() {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const rlimit few{256, before_.rlim_max};
    EXPECT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
    for (int taken; (taken = ::open("/dev/null", O_RDONLY | O_CLOEXEC)) >= 0;) taken_.push_back(taken);
    EXPECT_EQ(errno, EMFILE);
  }
  NoDescriptorsLeft(const NoDescriptorsLeft&) = delete;
  NoDescriptorsLeft& operator=(const NoDescriptorsLeft&) = delete;
  ~NoDescriptorsLeft() {
    for (const int taken : taken_) ::close(taken);
    ::setrlimit(RLIMIT_NOFILE, &before_);
  }

 private:
  rlimit before_{};
  std::vector<int> taken_;
};

TEST_F(ServerTest, WithoutDescriptorsIsBusyAndLosesNothing) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  EXPECT_EQ(connection.get("/healthz").status, 200);
  folder_.write("packs/new.glb", single_);
  const std::vector<std::string> there{url_, "/packs/single.glb", "/packs/new.glb", "/packs.json", "/main.js"};
  {
    const NoDescriptorsLeft none;
    for (const std::string& target : there) {
      const RawResponse busy = connection.get(target);
      EXPECT_EQ(busy.status, 503) << target;
      EXPECT_EQ(busy.fields.count("retry-after"), 1u) << target;
    }
    EXPECT_EQ(connection.get("/packs/absent.glb").status, 404);
    EXPECT_EQ(connection.get("/healthz").status, 200);
  }
  for (const std::string& target : there) EXPECT_EQ(connection.get(target).status, 200) << target;
}

TEST_F(ServerTest, KeepsConnectionsAlive) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  for (int i = 0; i < 50; i++) ASSERT_EQ(connection.get(url_, "Range: bytes=7-9\r\n").body, pack_.substr(7, 3));
  connection.send(
      "GET /healthz HTTP/1.1\r\nHost: x\r\n\r\nGET /packs/single.glb HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
  EXPECT_EQ(connection.receive().body, "ok\n");
  EXPECT_EQ(connection.receive().body, single_);
  EXPECT_TRUE(connection.ended());
}

TEST_F(ServerTest, DropsSilentAndSlowClients) {
  options_.idle = 100ms;
  options_.slow = 100ms;
  folder_.write("packs/large.glb", pack_of(20 << 20));  // more than the system's socket buffers hold
  RunningServer server(options_);
  RawConnection silent(server.port());
  RawConnection dripping(server.port());
  dripping.send("GET / HT");
  RawConnection slow(server.port());
  slow.send("GET /packs/large.glb HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_TRUE(silent.ended());
  EXPECT_TRUE(dripping.ended());
  std::this_thread::sleep_for(400ms);
  EXPECT_LT(slow.receive().body.size(), size_t(20) << 20);
}

TEST_F(ServerTest, ManyClientsAtOnce) {
  options_.max_connections = 8;  // the others wait in the queue
  RunningServer server(options_);
  std::vector<std::thread> clients;
  for (int client = 0; client < 24; client++)
    clients.emplace_back([&, client] {
      RawConnection connection(server.port());
      for (size_t i = 0; i < 20; i++) {
        const size_t first = (i * 7919 + static_cast<size_t>(client) * 104729) % 290000;
        const std::string range = "Range: bytes=" + std::to_string(first) + "-" + std::to_string(first + 4999) + "\r\n";
        EXPECT_EQ(connection.get(url_, range).body, pack_.substr(first, 5000));
      }
    });
  for (std::thread& client : clients) client.join();
}

TEST_F(ServerTest, StopsAfterTheAnswersUnderWay) {
  const std::string large = pack_of(20 << 20);
  folder_.write("packs/large.glb", large);
  auto server = std::make_unique<RunningServer>(options_);
  RawConnection idle(server->port());
  RawConnection busy(server->port());
  EXPECT_EQ(idle.get("/healthz").status, 200);
  busy.send("GET /packs/large.glb HTTP/1.1\r\nHost: x\r\n\r\n");
  std::this_thread::sleep_for(50ms);  // the answer has begun, and cannot end before somebody reads it
  server->server().stop();
  EXPECT_TRUE(idle.ended());
  EXPECT_EQ(busy.receive().body.size(), large.size());
  server.reset();
}

TEST_F(ServerTest, WrongOptionsAreErrors) {
  const auto listens = [](ServerOptions options) { return Server::listen(options).has_value(); };
  ServerOptions options = options_;
  options.packs.push_back(folder_.path() / "absent.glb");
  EXPECT_FALSE(listens(options));
  options = options_;
  options.packs.push_back(folder_.write("plain.glb", "glTF, but no pack"));
  EXPECT_FALSE(listens(options));
  options = options_;
  options.packs.push_back(folder_.write("elsewhere/single.glb", single_));
  EXPECT_FALSE(listens(options)) << "two packs of one name";
  options = options_;
  options.page = folder_.path() / "absent";
  EXPECT_FALSE(listens(options));
  options = options_;
  options.bind = "nowhere";
  EXPECT_FALSE(listens(options));
  RunningServer server(options_);
  options = options_;
  options.port = server.port();
  EXPECT_FALSE(listens(options)) << "the port is taken";
}

}  // namespace
}  // namespace lightwell
