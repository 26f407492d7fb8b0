// SPDX-License-Identifier: Apache-2.0
#include "lightwell/transport/fetch.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>

#include "lightwell/base/file.h"
#include "lightwell/cli/arguments.h"
#include "lightwell/cli/pack_name.h"
#include "lightwell/cli/received_scene.h"

namespace lightwell {
namespace {

struct Options {
  std::string url;
  std::string output;
  ClientOptions client;
  uint64_t bits_per_second = 0;
  double latency_milliseconds = 0;
  double timeout = 30;  ///< seconds; 0 is never
};

// Whether a browser would take the text for a URL: "localhost:8080/packs/room.lw.glb", "example.com/room.lw.glb",
// "ftp://example".
bool resembles_url(const std::string& text) {
  static const std::regex beginning(R"(^([^/]+:\d+(/|$)|\w[\w-]*(\.\w[\w-]*)+/|\w+://))");
  return std::regex_search(text, beginning);
}

Result<std::vector<uint8_t>> read_pack(const std::string& path) {
  LW_CHECK(refuse_builtin_scene(path));
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown) && resembles_url(path))
    return fail({path, "", "no such file; a URL begins with http://", ErrorKind::io});
  return read_file(path);
}

// The URL with its scheme in lower case; schemes ignore case (RFC 3986, section 3.1).
std::string with_plain_scheme(std::string url) {
  const size_t end = url.find("://");
  if (end != std::string::npos)
    std::transform(url.begin(), url.begin() + static_cast<ptrdiff_t>(end), url.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return url;
}

Result<std::unique_ptr<Transport>> open_transport(const Options& options) {
  std::unique_ptr<Transport> transport;
  const std::string url = with_plain_scheme(options.url);
  if (url.starts_with("https://"))
    return fail(ErrorKind::unsupported, "",
                "https is not spoken here; save the file with another program, such as curl, and fetch that");
  if (url.starts_with("http://")) {
    LW_TRY(http, http_transport(url));
    transport = std::move(http);
  } else {
    LW_TRY(bytes, read_pack(options.url));
    transport = memory_transport(std::move(bytes));
  }
  const LineShape shape{static_cast<double>(options.bits_per_second), options.latency_milliseconds / 1000};
  if (shape.bits_per_second <= 0 && shape.latency <= 0) return transport;
  return shaped_transport(std::move(transport), shape);
}

// The guard of a fetch: Ctrl-C and --timeout end it, and outages give warnings.
FetchGuard guard_of(const Options& options, const Progress& progress, const Console& console) {
  FetchGuard guard;
  guard.cancelled = [&] { return progress.cancelled(); };
  guard.outage = [&](const std::string& reason) { console.warn(options.url + ": " + reason + "; trying again"); };
  if (options.timeout > 0) guard.patience = options.timeout;
  return guard;
}

Result<FetchOutcome> run(const Options& options, const Progress& progress, const Console& console) {
  if (!options.output.empty()) LW_CHECK(check_output(options.output, {options.url}));
  LW_TRY(transport, open_transport(options));
  Client client(options.client);
  ReceivedScene scene;
  const bool keep = !options.output.empty();
  auto outcome = fetch(
      client, *transport,
      [&](const Update& update) {
        if (keep) scene.apply(update);
      },
      guard_of(options, progress, console));
  if (!outcome || !keep) return outcome;
  LW_TRY(glb, scene.glb());
  LW_CHECK(write_file(options.output, glb));
  return outcome;
}

nlohmann::ordered_json figures(const FetchOutcome& outcome) {
  nlohmann::ordered_json timeline = nlohmann::ordered_json::array();
  for (const FetchOutcome::Moment& moment : outcome.timeline)
    timeline.push_back(
        {{"seconds", moment.seconds}, {"bytes", moment.bytes}, {"faces", moment.faces}, {"nodes", moment.nodes}});
  return {{"bytes", outcome.bytes},
          {"requests", outcome.requests},
          {"seconds", outcome.seconds},
          {"first_picture", {{"bytes", outcome.first_picture.bytes}, {"seconds", outcome.first_picture.seconds}}},
          {"timeline", std::move(timeline)}};
}

int fetch_pack(const Options& options, const Console& console) {
  const ConsoleProgress progress(console);
  auto outcome = run(options, progress, console);
  if (!outcome) return console.fail(in_file(outcome.error(), options.url));
  nlohmann::ordered_json result = figures(*outcome);
  if (!console.json) result.erase("timeline");
  if (options.output != "-") console.print(result);
  return 0;
}

}  // namespace

CLI::App* add_fetch(CLI::App& program, Console& console, std::function<int()>& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("fetch", "Streams and decodes a pack without a screen, prints what was there when");
  command->add_option("url", options->url, "http://HOST[:PORT]/PATH of a pack, or a file")->required()->type_name("");
  add_output(*command, options->output, {".glb"}, "Write the scene as it was received: FILE.glb, - for stdout");
  add_choice<Strategy>(
      *command, "--strategy", options->client.strategy,
      {{"interleave", Strategy::interleave}, {"geometry", Strategy::geometry}, {"light", Strategy::light}},
      "What comes first");
  add_fill_option(*command, options->client.fill, "How missing light is filled");
  add_count(*command, "--rate", options->bits_per_second, "Slow the line down to so many bits a second: 500k, 10M",
            "a number of bits a second, such as 500k or 10M");
  add_number(*command, "--latency", options->latency_milliseconds, {0, 1e6},
             "Delay every answer by so many milliseconds");
  add_number(*command, "--timeout", options->timeout, {0, 1e6},
             "Give up after so many seconds without a byte; 0 is never")
      ->default_str("30");
  command->footer("Example:\n  lightwell fetch http://127.0.0.1:8080/packs/room.lw.glb --rate 10M --latency 50");
  command->callback([=, &console, &chosen] { chosen = [=, &console] { return fetch_pack(*options, console); }; });
  return command;
}

}  // namespace lightwell
