// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <map>
#include <memory>
#include <optional>

#include "calibration/files/error.h"
#include "calibration/foreground_matte.h"
#include "calibration/program/program.h"
#include "calibration/program/warnings.h"
#include "renderer/layers/layer_images.h"
#include "renderer/layers/layer_names.h"
#include "renderer/render_quality.h"
#include "renderer/render_site.h"
#include "renderer/tiles/stop_signals.h"
#include "renderer/tiles/stream_writer.h"
#include "renderer/tiles/tev_stream.h"
#include "renderer/trace/profile.h"

namespace insitu {
namespace {

void PrintReport(FILE* out, const RenderSiteReport& report) {
  if (report.is_within_building) {
    std::fprintf(out, "%s: not rendered\n", report.photo.c_str());
    return;
  }
  const double pixels = report.pixels;
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
const std::map<std::string, Sharpness> kSharpness = {{"measured", Sharpness::kMeasured},
                                                     {"ideal", Sharpness::kIdeal}};

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

template <typename Value>
std::string NameOf(Value value, const std::map<std::string, Value>& named) {
  return std::ranges::find(named, value, &std::pair<const std::string, Value>::second)->first;
}

struct RenderCommand {
  SitePaths site;
  RenderSiteOptions options;
  std::string frame = NameOf(options.frame, kFrames);
  std::string sharpness = NameOf(options.sharpness, kSharpness);
  std::string tev;
  std::string quality = NameOf(Quality::kFinal, kQualities);
  bool is_beside = false;
  std::string layers;
  std::string avr = NameOf(AvrLevel::kMaterials, kAvrLevels);
  bool no_building = false, streams = false, base64 = false, timing = false;
};

void AddPhotoOptions(ProgramOptions* program, RenderCommand* command) {
  program->Value("--photo", &command->options.photos, "only this photograph (may be repeated)");
  program->Value(
      "--frame", &command->frame, "pixel grid: the photograph's, or that of its input image",
      {.one_of = {"photo", "pinhole"}, .text = "photo|pinhole [" + command->frame + "]"});
  program->Value("--variant", &command->site.variant,
                 "the design in variants/VARIANT instead of building/; to montages/VARIANT");
  program->Value("--hour", &command->site.hour,
                 "the light of work/hours/HOUR, which insitu-relight has made; to <photo>@HOUR");
  program->Flag("--no-building", &command->no_building, "render the empty site", "--variant");
}

// What decides on the pixels.
void AddRenderOptions(ProgramOptions* program, RenderCommand* command) {
  RenderSiteOptions& options = command->options;
  program->Value("--quality", &command->quality,
                 "fast: 4 rays a pixel, sun and sky alone, no search for shadows; draft: 4 rays, 8 "
                 "at outlines, one bounce; final: as the other options say",
                 {.one_of = {"fast", "draft", "final"},
                  .text = "fast|draft|final [" + command->quality + "]"});
  program->Flag("--beside", &command->is_beside,
                "a lesser quality is named <photo>~QUALITY, so that the final pictures stay");
  program->Value("--layers", &command->layers,
                 "all, or names with commas between them: what the picture is made of, in one EXR "
                 "of many parts, <photo>.parts.exr; a name that is none tells those there are");
  program->Flag("--tiff", &options.with_tiff,
                "a TIFF of 16 bits, too, whatever the photograph is: <photo>.tif");
  program->Value("--avr", &command->avr,
                 "what of the building is shown: 0 its silhouette, 1 its outline, hidden parts "
                 "dashed, 2 its form in one grey, 3 its materials; 0 to 2 to <photo>~avrN",
                 {.one_of = {"0", "1", "2", "3"}, .text = "0|1|2|3 [" + command->avr + "]"});
  program->Value("--most-rays", &options.render.most_rays, "rays a pixel at most",
                 {.shows_default = true, .one_of = {"4", "8", "12", "16"}});
  program->Flag("--uniform-ambient", &options.uniform_ambient,
                "the paper's ambient light, alike everywhere, instead of light among surfaces");
  program->Flag("--paper", &options.as_printed,
                "to the letter of the paper: --uniform-ambient --no-shadow-search --sharpness "
                "ideal, Hall and Greenberg's mirrors, the horizon's colour for all that leaves, "
                "surfaces looked up by their image attribute alone; after insitu-light --paper");
  program->Flag("!--no-shadow-search", &options.find_shadows,
                "take what no polygon shades as lit by the sun, whatever the photograph shows");
  program->Value("--reach", &options.render.reach,
                 "change in 8-bit codes up to which the photograph's pixel stays",
                 {.shows_default = true, .check = OptionCheck::kNonNegative});
  program->Value(
      "--sharpness", &command->sharpness,
      "edges as sharp as insitu-light measured those of the photograph, or as a pixel's square",
      {.one_of = {"measured", "ideal"}, .text = "measured|ideal [" + command->sharpness + "]"});
  program->Flag("--grain", &options.with_grain, "computed pixels get the photograph's grain");
  program->Value("--bounces", &options.bounces,
                 "bounces of light among surfaces; 0: sun and sky alone; without: all",
                 {.check = OptionCheck::kNonNegative});
}

void AddRunOptions(ProgramOptions* program, RenderCommand* command) {
  program->Value("--threads", &command->options.render.threads, "threads; 0: all cores",
                 {.shows_default = true, .check = OptionCheck::kNonNegative});
  program->Flag(
      "--stream", &command->streams,
      "the picture on standard output as it comes, for insitu view -; reports on standard "
      "error");
  program->Flag("--stream-base64", &command->base64, "the same in a third of the bytes");
  program->Value("--tev", &command->tev,
                 "HOST:PORT, the picture in the viewer tev as it comes, linear");
  program->Flag("--timing", &command->timing, "print the shares of CPU time");
}

// What results are named by that do not take the montages' place.
std::string BesideName(const RenderCommand& command) {
  const std::string level =
      kAvrLevels.at(command.avr) == AvrLevel::kMaterials ? "" : "avr" + command.avr;
  if (!command.is_beside || command.quality == NameOf(Quality::kFinal, kQualities)) return level;
  return level.empty() ? command.quality : level + "~" + command.quality;
}

void RenderAndReport(const RenderCommand& command) {
  RenderSiteOptions options = command.options;
  SitePaths site = command.site;
  RequireVariant(command.site);
  RequireHour(command.site);
  options.frame = kFrames.at(command.frame);
  options.sharpness = kSharpness.at(command.sharpness);
  options.with_building = !command.no_building;
  options.keeps_pictures = false;
  options.avr = kAvrLevels.at(command.avr);
  if (options.as_printed) {
    options.uniform_ambient = true;
    options.find_shadows = false;
    options.sharpness = Sharpness::kIdeal;
  }
  site.beside = BesideName(command);
  if (!command.layers.empty()) options.layers = ChosenLayers(command.layers);
  Lessen(kQualities.at(command.quality), &options);
  NoteStopSignals();
  options.stops = IsStopSignalled;
  const auto profile = command.timing ? std::make_unique<Profile>() : nullptr;
  const bool streams = command.streams || command.base64;
  FILE* const out = streams ? stderr : stdout;
  std::optional<TevConnection> tev;
  std::optional<RenderStream> stream;
  if (streams) {
    stream.emplace(STDOUT_FILENO,
                   TextFormat(command.base64 ? StreamCoding::kBase64 : StreamCoding::kDecimal));
  }
  if (IsDrawn(options.avr) && (streams || !command.tev.empty())) {
    throw InputError("--stream", "is of what is rendered, not of the drawings of --avr 0 and 1");
  }
  if (IsDrawn(options.avr) && !options.layers.empty()) {
    throw InputError("--layers", "is of what is rendered, not of the drawings of --avr 0 and 1");
  }
  if (!command.tev.empty()) {
    if (streams) throw InputError("--tev", "is not had together with --stream");
    tev.emplace(command.tev);
    stream.emplace(tev->socket(), TevFormat());
  }
  if (stream) options.watcher = &*stream;
  std::fputs(WarningLines(UnreadDrawings(command.site)).c_str(), out);
  for (const RenderSiteReport& report : RenderSite(site, options)) {
    PrintReport(out, report);
    if (!report.is_within_building) PrintQuality(out, report, options);
    std::fputs(WarningLines(report.remarks).c_str(), out);
  }
  if (profile) std::fputs(profile->Report().c_str(), out);
}

int RunRender(int argc, char** argv) {
  ProgramOptions program("Renders the planned building into the photographs of its site.",
                         "insitu-render");
  program.Footer(
      "Example: insitu-render path/to/site --photo IMG_2102\n"
      "Reads work/environment.json, work/building.json, work/input_images/ and what\n"
      "stands in front, survey/foreground/<photo>.png (white: in front), and where something\n"
      "keeps the sun away, survey/shadows/<photo>.png (black), which is found if it is not there;\n"
      "writes montages/<photo>.exr, .png and .jpg, and .layers.exr: the shares of the\n"
      "photograph (red), computed (green) and in front (blue); and .shadows.exr: the share of\n"
      "the sun that the photograph shows to arrive (red) and its standard deviation (green);\n"
      "and .unseen.exr: how much of each pixel is of surfaces, mirrored or behind glass, that no\n"
      "photograph shows (red), if any is; with --layers .parts.exr, what all of it is made of.\n"
      "Ctrl-C ends it with status 3 when the tiles at work are done; whatever ends it, the same\n"
      "command goes on where it was and comes to the same bytes.");
  RenderCommand command;
  program.Site(&command.site);
  AddPhotoOptions(&program, &command);
  AddRenderOptions(&program, &command);
  AddRunOptions(&program, &command);
  bool stopped = false;
  const int status = RunProgram(program, argc, argv, [&] {
    try {
      RenderAndReport(command);
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
