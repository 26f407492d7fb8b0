// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/file.h"
#include "lightwell/cli/command.h"
#include "lightwell/cli/option_kinds.h"
#include "lightwell/render/compare.h"
#include "lightwell/texture/image_file.h"

namespace lightwell {
namespace {

struct Options {
  std::string picture, reference;
  std::string metric = "flip";
  std::string heat_map;
};

Result<Comparison> run(const Options& options) {
  if (!options.heat_map.empty()) LW_CHECK(check_output(options.heat_map, {options.picture, options.reference}));
  LW_TRY(picture, read_picture(options.picture));
  LW_TRY(reference, read_picture(options.reference));
  auto comparison = compare(picture, reference, *metric_of(options.metric), Display{.tone = ToneCurve::none});
  if (!comparison) return fail(in_file(comparison.error(), options.picture));
  if (!options.heat_map.empty())
    LW_CHECK(write_file(options.heat_map, write_png(heat_map(*comparison, picture.width, picture.height))));
  return comparison;
}

}  // namespace

CLI::App* add_diff(CLI::App& program, Console& console, std::function<int()>& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("diff", "Compares two pictures (PNG, JPEG, WebP, EXR or PFM)");
  command->add_option("picture", options->picture, "A picture")->required()->type_name("");
  command->add_option("reference", options->reference, "What it should be")->required()->type_name("");
  add_choice<std::string>(
      *command, "--metric", options->metric,
      {{"rmse", "rmse"}, {"relmse", "relmse"}, {"deltae", "deltae"}, {"lab", "lab"}, {"flip", "flip"}},
      "How they are compared; lab is the distance in CIE Lab, in percent of the range of L");
  add_output(*command, options->heat_map, {".png"}, "A PNG of the differences; - is stdout");
  command->footer("Example:\n  lightwell diff page.png reference.png --metric deltae -o where.png");
  command->callback([=, &console, &chosen] {
    chosen = [=, &console] {
      auto comparison = run(*options);
      if (!comparison) return console.fail(comparison.error());
      if (options->heat_map != "-")
        console.print({{"mean", comparison->mean}, {"p95", comparison->p95}, {"max", comparison->max}});
      return 0;
    };
  });
  return command;
}

}  // namespace lightwell
