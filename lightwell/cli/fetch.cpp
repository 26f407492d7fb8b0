// SPDX-License-Identifier: Apache-2.0
#include "lightwell/transport/fetch.h"

#include "lightwell/base/file.h"
#include "lightwell/cli/arguments.h"
#include "lightwell/cli/received_scene.h"

namespace lightwell {
namespace {

struct Options {
  std::string url;
  std::string output;
  ClientOptions client;
  double bits_per_second = 0;
  double latency_milliseconds = 0;
};

Result<std::unique_ptr<Transport>> open_transport(const Options& options) {
  std::unique_ptr<Transport> transport;
  if (options.url.starts_with("http://")) {
    LW_TRY(http, http_transport(options.url));
    transport = std::move(http);
  } else {
    LW_TRY(bytes, read_file(options.url));
    transport = memory_transport(std::move(bytes));
  }
  const LineShape shape{options.bits_per_second, options.latency_milliseconds / 1000};
  if (shape.bits_per_second <= 0 && shape.latency <= 0) return transport;
  return shaped_transport(std::move(transport), shape);
}

Result<FetchOutcome> run(const Options& options, const Progress& progress) {
  LW_TRY(transport, open_transport(options));
  Client client(options.client);
  ReceivedScene scene;
  const bool keep = !options.output.empty();
  auto outcome = fetch(
      client, *transport,
      [&](const Update& update) {
        if (keep) scene.apply(update);
      },
      [&] { return progress.cancelled(); });
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
  auto outcome = run(options, progress);
  if (!outcome) return console.fail(in_file(outcome.error(), options.url));
  nlohmann::ordered_json result = figures(*outcome);
  if (!console.json) result.erase("timeline");
  if (options.output != "-") console.print(result);
  return 0;
}

const std::map<std::string, Strategy> strategies = {
    {"interleave", Strategy::interleave}, {"geometry", Strategy::geometry}, {"light", Strategy::light}};
const std::map<std::string, Fill> fills = {
    {"push-pull", Fill::push_pull}, {"push-pull-smooth", Fill::push_pull_smooth}, {"none", Fill::none}};

}  // namespace

CLI::App* add_fetch(CLI::App& program, Console& console, std::function<int()>& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("fetch", "Streams and decodes a pack without a screen, prints what was there when");
  command->add_option("url", options->url, "http://… of a pack, or a file")->required();
  command->add_option("-o,--output", options->output, "Write the scene as it was received: FILE.glb, - for stdout");
  command->add_option("--strategy", options->client.strategy, "What comes first: interleave, geometry or light")
      ->transform(CLI::CheckedTransformer(strategies))
      ->default_str("interleave");
  command
      ->add_option("--fill", options->client.fill, "How missing light is filled: push-pull, push-pull-smooth or none")
      ->transform(CLI::CheckedTransformer(fills))
      ->default_str("push-pull");
  command
      ->add_option_function<std::string>(
          "--rate",
          [options](const std::string& text) {
            auto rate = parse_count(text);
            if (!rate || *rate == 0) throw CLI::ValidationError("--rate", text + " is not a rate");
            options->bits_per_second = static_cast<double>(*rate);
          },
          "Slow the line down to so many bits a second (10M)")
      ->type_name("BITS/S");
  command->add_option("--latency", options->latency_milliseconds, "Delay every answer by so many milliseconds")
      ->check(CLI::NonNegativeNumber);
  command->footer("Example:\n  lightwell fetch http://127.0.0.1:8080/packs/room.lw.glb --rate 10M --latency 50");
  command->callback([=, &console, &chosen] { chosen = [=, &console] { return fetch_pack(*options, console); }; });
  return command;
}

}  // namespace lightwell
