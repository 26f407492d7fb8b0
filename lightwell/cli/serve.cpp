// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "lightwell/cli/command.h"
#include "lightwell/cli/option_kinds.h"
#include "lightwell/cli/pack_name.h"
#include "lightwell/cli/scene_watch.h"
#include "lightwell/server/server.h"

namespace lightwell {
namespace {

struct Options {
  ServerOptions server;
  SceneWatch::Options watched;  // none without a scene
  double grace = std::chrono::duration<double>(ServerOptions{}.grace).count();
  bool open = false;
};

Server* running = nullptr;
volatile std::sig_atomic_t stopped = 0;  // the number of the signal

void stop_server(int signal) {
  stopped = signal;
  if (running != nullptr) running->stop();
}

// Where the page is installed, and a build links it: in the folder share beside the program's own.
std::filesystem::path page_folder() {
  std::error_code unknown;
  const std::filesystem::path program = std::filesystem::canonical("/proc/self/exe", unknown);
  return program.parent_path().parent_path() / "share" / "lightwell" / "page";
}

// Prints the URL: a sentence on a terminal, a line of JSON for a program.
void announce(const std::string& url, const Console& console) {
  if (!console.json && isatty(STDOUT_FILENO) != 0)
    std::printf("Lightwell is at %s until you press Ctrl-C.\n", url.c_str());
  else
    std::printf("%s\n", nlohmann::json{{"url", url}}.dump().c_str());
  std::fflush(stdout);
}

int serve_packs(const ServerOptions& options, bool open, const Console& console) {
  for (const std::filesystem::path& pack : options.packs)
    if (auto name = refuse_builtin_scene(pack.string()); !name) return console.fail(name.error());
  auto server = Server::listen(options);
  if (!server) return console.fail(server.error());
  running = &*server;
  const std::string url = server->url();
  for (const std::filesystem::path& folder : server->catalog().empty_folders())
    console.warn(folder.string() + ": there is no pack in it yet");
  announce(url, console);
  if (open && std::system(("xdg-open '" + url + "' >/dev/null 2>&1 &").c_str()) != 0)
    console.warn("no browser could be opened");
  if (stopped == 0) server->run();
  running = nullptr;
  return 0;
}

int serve_watched(Options options, const Console& console) {
  options.watched.quiet = console.quiet;
  auto watch = SceneWatch::make(options.watched, [] { return stopped != 0; });
  if (!watch) return console.fail(watch.error());
  if (const int status = watch->bake(); status != 0) return status;
  watch->begin();
  options.server.packs.push_back(watch->pack());
  options.server.packs_change = true;
  const int status = serve_packs(options.server, options.open, console);
  stopped = stopped != 0 ? stopped : SIGTERM;  // for the watch, where nothing could be served
  return status;
}

int serve(const Options& options, const Console& console) {
  std::signal(SIGINT, stop_server);
  std::signal(SIGTERM, stop_server);
  if (!options.watched.scene.empty()) return serve_watched(options, console);
  return serve_packs(options.server, options.open, console);
}

void add_watch_options(CLI::App& command, SceneWatch::Options& watched) {
  CLI::Option* watch =
      command.add_option("--watch", watched.scene, "A scene to bake, again whenever it changes: the page follows");
  watch->type_name("SCENE");
  const auto take = [&watched](const std::string& text) -> Result<void> {
    watched.bake = CLI::detail::split_up(text);
    return {};
  };
  add_text(command, "--bake", "OPTIONS", take, "Of --watch: options of the bakes, such as \"--sky --preview\"")
      ->needs(watch);
}

}  // namespace

CLI::App* add_serve(CLI::App& program, Console& console, std::function<int()>& chosen) {
  auto options = std::make_shared<Options>();
  options->server.page = page_folder();
  CLI::App* command =
      program.add_subcommand("serve", "HTTP server for packs, with the page; prints its address, to a program as JSON");
  command->add_option("packs", options->server.packs, "Packs, or folders of packs; each is at /packs/NAME")
      ->type_name("");
  add_watch_options(*command, options->watched);
  command->add_option("--bind", options->server.bind, "IP address to listen on, or localhost")
      ->capture_default_str()
      ->type_name("ADDRESS");
  add_whole(*command, "--port", options->server.port, {0, 65535}, "Port; 0 for any free one");
  command
      ->add_option("--page", options->server.page, "Folder of the page (default: the one that came with the program)")
      ->type_name("FOLDER");
  add_whole(*command, "--max-connections", options->server.max_connections, {1, 1e6},
            "Open at once; beyond it idle and slow ones are closed for new ones");
  add_whole(*command, "--connections-per-address", options->server.connections_per_address, {0, 1e6},
            "The same for one address, or IPv6 network; 0 for any number, as behind a proxy");
  add_whole(*command, "--requests-per-second", options->server.requests_per_second, {0, 1e6},
            "Of one address; beyond it the answer is 429. 0 for any number");
  add_number(*command, "--grace", options->grace, {0, 86400},
             "Seconds that SIGTERM and Ctrl-C leave to answers under way; a second signal ends at once")
      ->default_str("5");
  command->add_flag("--open", options->open, "Open the page in a browser");
  command->footer(
      "Examples:\n  lightwell serve room.lw.glb\n  lightwell serve packs/ --bind 0.0.0.0 --port 80\n"
      "  lightwell serve --watch room.glb --bake \"--sky --preview\"");
  command->callback([=, &console, &chosen] {
    const std::chrono::duration<double> grace(options->grace);
    options->server.grace = std::chrono::duration_cast<std::chrono::milliseconds>(grace);
    if (options->server.packs.empty() && options->watched.scene.empty())
      throw CLI::RequiredError("packs, or --watch with a scene,");
    chosen = [=, &console] { return serve(*options, console); };
  });
  return command;
}

}  // namespace lightwell
