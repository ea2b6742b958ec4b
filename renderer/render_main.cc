// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <map>
#include <memory>
#include <optional>

#include "calibration/foreground_matte.h"
#include "calibration/program/program.h"
#include "calibration/program/warnings.h"
#include "renderer/render_site.h"
#include "renderer/tiles/stop_signals.h"
#include "renderer/tiles/stream_writer.h"
#include "renderer/trace/profile.h"

namespace insitu {
namespace {

void PrintReport(FILE* out, const RenderSiteReport& report) {
  if (report.is_within_building) {
    std::fprintf(out, "%s: not rendered\n", report.photo.c_str());
    return;
  }
  const Raster& picture = report.result.linear;
  const double pixels = static_cast<double>(picture.width) * picture.height;
  std::fprintf(
      out, "%s: building %.1f %%, changed %.1f %% of the pixels, %.2f rays a pixel, %.1f s\n",
      report.photo.c_str(), 100 * report.result.building_pixels / pixels,
      100 * report.result.changed_pixels / pixels, report.result.mean_rays, report.seconds);
  if (report.result.unseen_pixels > 0) {
    std::fprintf(out,
                 "  mirrors and glass show in %ld pixels what no photograph does, by their shares "
                 "%.0f pixels in all: %s.unseen.exr\n",
                 report.result.unseen_pixels, report.result.unseen_area, report.photo.c_str());
  }
  if (!report.uncertainty) return;
  std::fprintf(
      out, "  its %d corners stand to %.2f px (%.1f mm), %.2f px (%.1f mm) at worst, one sigma\n",
      report.uncertainty->corners, report.uncertainty->median_px,
      1000 * report.uncertainty->median_m, report.uncertainty->worst_px,
      1000 * report.uncertainty->worst_m);
}

const std::map<std::string, Frame> kFrames = {{"photo", Frame::kPhoto},
                                              {"pinhole", Frame::kPinhole}};

// "--frame photo|pinhole", as --help shows it.
void AddFrame(CLI::App* app, Frame* frame) {
  const auto is_default = [&](const auto& named) { return named.second == *frame; };
  app->add_option_function<std::string>(
         "--frame", [frame](const std::string& name) { *frame = kFrames.at(name); },
         "pixel grid: the photograph's, or that of its input image")
      ->check(CLI::IsMember(kFrames).description(""))
      ->option_text("photo|pinhole [" + std::ranges::find_if(kFrames, is_default)->first + "]");
}

// "--sharpness measured|ideal"
void AddSharpness(CLI::App* app, Sharpness* sharpness) {
  static const std::map<std::string, Sharpness> kSharpness = {{"measured", Sharpness::kMeasured},
                                                              {"ideal", Sharpness::kIdeal}};
  app->add_option_function<std::string>(
         "--sharpness", [=](const std::string& name) { *sharpness = kSharpness.at(name); },
         "edges as sharp as insitu-light measured those of the photograph, or as a pixel's square")
      ->check(CLI::IsMember(kSharpness).description(""))
      ->option_text("measured|ideal [measured]");
}

void PrintQuality(FILE* out, const RenderSiteReport& report, const RenderSiteOptions& options) {
  if (const auto& spread = report.point_spread) {
    std::fprintf(
        out,
        "  sharpness of the photograph: sigma %.2f px in the centre, %.2f px in the corners "
        "(%d pieces of edges)\n",
        spread->center_sigma, spread->corner_sigma, spread->edges);
  } else if (options.sharpness == Sharpness::kMeasured) {
    std::fprintf(out, "  sharpness ideal: insitu-light measured none in this photograph\n");
  }
  if (options.with_grain && !report.has_grain) {
    std::fprintf(out, "  no grain: insitu-light measured none in this photograph\n");
  }
}

constexpr int kStopped = 3;  // exit status

// What decides on the pixels.
void AddRenderOptions(CLI::App* app, RenderSiteOptions* options) {
  app->add_option("--most-rays", options->render.most_rays, "rays a pixel at most")
      ->check(CLI::IsMember({4, 8, 12, 16}))
      ->capture_default_str();
  app->add_flag("--uniform-ambient", options->uniform_ambient,
                "the paper's ambient light, alike everywhere, instead of light among surfaces");
  app->add_flag("!--no-shadow-search", options->find_shadows,
                "take what no polygon shades as lit by the sun, whatever the photograph shows");
  app->add_option("--reach", options->render.reach,
                  "change in 8-bit codes up to which the photograph's pixel stays")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  AddSharpness(app, &options->sharpness);
  app->add_flag("--grain", options->with_grain, "computed pixels get the photograph's grain");
  app->add_option("--bounces", options->bounces,
                  "bounces of light among surfaces; 0: sun and sky alone; without: all")
      ->check(CLI::NonNegativeNumber);
}

struct Output {
  bool streams = false, base64 = false, timing = false;
};

void RenderAndReport(const SitePaths& site, RenderSiteOptions* options, const Output& output) {
  const auto profile = output.timing ? std::make_unique<Profile>() : nullptr;
  FILE* const out = output.streams || output.base64 ? stderr : stdout;
  std::optional<RenderStream> stream;
  if (output.streams || output.base64) {
    stream.emplace(STDOUT_FILENO, output.base64 ? StreamCoding::kBase64 : StreamCoding::kDecimal);
    options->watcher = &*stream;
  }
  std::fputs(WarningLines(UnreadDrawings(site)).c_str(), out);
  for (const RenderSiteReport& report : RenderSite(site, *options)) {
    PrintReport(out, report);
    if (!report.is_within_building) PrintQuality(out, report, *options);
    std::fputs(WarningLines(report.remarks).c_str(), out);
  }
  if (profile) std::fputs(profile->Report().c_str(), out);
}

int RunRender(int argc, char** argv) {
  CLI::App app("Renders the planned building into the photographs of its site.", "insitu-render");
  app.footer(
      "Example: insitu-render path/to/site --photo IMG_2102\n"
      "Reads work/environment.json, work/building.json, work/input_images/ and what\n"
      "stands in front, survey/foreground/<photo>.png (white: in front), and where something\n"
      "keeps the sun away, survey/shadows/<photo>.png (black), which is found if it is not there;\n"
      "writes montages/<photo>.exr, .png and .jpg, and .layers.exr: the shares of the\n"
      "photograph (red), computed (green) and in front (blue); and .shadows.exr: the share of\n"
      "the sun that the photograph shows to arrive (red) and its standard deviation (green);\n"
      "and .unseen.exr: how much of each pixel is of surfaces, mirrored or behind glass, that no\n"
      "photograph shows (red), if any is.\n"
      "Ctrl-C ends it with status 3 when the tiles at work are done; whatever ends it, the same\n"
      "command goes on where it was and comes to the same bytes.");
  SitePaths site;
  RenderSiteOptions options;
  Output output;
  bool no_building = false, stopped = false;
  AddSite(&app, &site);
  app.add_option("--photo", options.photos, "only this photograph (may be repeated)");
  AddFrame(&app, &options.frame);
  app.add_flag("--no-building", no_building, "render the empty site");
  AddRenderOptions(&app, &options);
  app.add_option("--threads", options.render.threads, "threads; 0: all cores")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_flag("--stream", output.streams,
               "the picture on standard output as it comes, for insitu view -; reports on standard "
               "error");
  app.add_flag("--stream-base64", output.base64, "the same in a third of the bytes");
  app.add_flag("--timing", output.timing, "print the shares of CPU time");
  const int status = RunProgram(app, argc, argv, [&] {
    options.with_building = !no_building;
    NoteStopSignals();
    options.stops = IsStopSignalled;
    try {
      RenderAndReport(site, &options, output);
    } catch (const RenderStopped& told) {
      std::cerr << told.what() << "\n";
      stopped = true;
    }
  });
  return status == 0 && stopped ? kStopped : status;
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) { return insitu::RunRender(argc, argv); }
