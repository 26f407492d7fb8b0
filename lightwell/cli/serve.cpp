// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "lightwell/cli/command.h"
#include "lightwell/cli/option_kinds.h"
#include "lightwell/cli/pack_name.h"
#include "lightwell/server/server.h"

namespace lightwell {
namespace {

Server* running = nullptr;

void stop_server(int) {
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

int serve(const ServerOptions& options, bool open, const Console& console) {
  for (const std::filesystem::path& pack : options.packs)
    if (auto name = refuse_builtin_scene(pack.string()); !name) return console.fail(name.error());
  auto server = Server::listen(options);
  if (!server) return console.fail(server.error());
  running = &*server;
  std::signal(SIGINT, stop_server);
  std::signal(SIGTERM, stop_server);
  const std::string url = server->url();
  for (const std::filesystem::path& folder : server->catalog().empty_folders())
    console.warn(folder.string() + ": there is no pack in it yet");
  announce(url, console);
  if (open && std::system(("xdg-open '" + url + "' >/dev/null 2>&1 &").c_str()) != 0)
    console.warn("no browser could be opened");
  server->run();
  running = nullptr;
  return 0;
}

}  // namespace

CLI::App* add_serve(CLI::App& program, Console& console, std::function<int()>& chosen) {
  struct Options {
    ServerOptions server;
    double grace = std::chrono::duration<double>(ServerOptions{}.grace).count();
    bool open = false;
  };
  auto options = std::make_shared<Options>();
  options->server.page = page_folder();
  CLI::App* command = program.add_subcommand("serve", "HTTP server for packs, with the page");
  command->add_option("packs", options->server.packs, "Packs, or folders of packs; each is at /packs/NAME")
      ->required()
      ->type_name("");
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
  command->footer("Examples:\n  lightwell serve room.lw.glb\n  lightwell serve packs/ --bind 0.0.0.0 --port 80");
  command->callback([=, &console, &chosen] {
    const std::chrono::duration<double> grace(options->grace);
    options->server.grace = std::chrono::duration_cast<std::chrono::milliseconds>(grace);
    chosen = [=, &console] { return serve(options->server, options->open, console); };
  });
  return command;
}

}  // namespace lightwell
