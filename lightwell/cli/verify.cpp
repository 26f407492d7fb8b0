// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/verify.h"

#include "lightwell/cli/command.h"
#include "lightwell/cli/input_file.h"
#include "lightwell/cli/pack_name.h"

namespace lightwell {
namespace {

int verify(const std::string& path, const Console& console) {
  if (auto name = refuse_builtin_scene(path); !name) return console.fail(name.error());
  auto pack = with_input(path, OpenedPack::open_file);
  if (!pack) return console.fail(in_file(pack.error(), path));
  const Verification verification = verify_pack(*pack);
  const bool ok = verification.errors.empty();
  if (console.json)
    console.print({{"ok", ok}, {"blocks", verification.blocks}, {"errors", verification.errors}});
  else if (ok)
    console.print({{"ok", ok}, {"blocks", verification.blocks}});
  for (const std::string& error : verification.errors) console.fail({path, "", error});
  return ok ? 0 : 1;
}

}  // namespace

CLI::App* add_verify(CLI::App& program, Console& console, std::function<int()>& chosen) {
  auto path = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand("verify", "Reads every block of a pack, checks and decodes all of it");
  command->add_option("pack", *path, "A pack; - is stdin")->required()->type_name("");
  command->footer("Example:\n  lightwell verify room.lw.glb");
  command->callback([=, &console, &chosen] { chosen = [=, &console] { return verify(*path, console); }; });
  return command;
}

}  // namespace lightwell
