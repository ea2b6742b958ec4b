// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/batch/contact_sheet.h"

#include <cctype>
#include <string_view>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"
#include "calibration/photo/exif.h"
#include "calibration/photo/photo_thumbnail.h"
#include "calibration/program/html_text.h"
#include "calibration/program/program.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr int kThumbnailWidth = 360;  // [px]

constexpr char kHead[] = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<style>
body { font: 15px/1.45 system-ui, sans-serif; margin: 1.5rem; color: #1b1b1b; background: #fafafa }
h1 { font-size: 1.4rem } h2 { font-size: 1.1rem; margin: 1.6rem 0 .6rem }
.cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(300px, 1fr)); gap: 1rem }
figure { margin: 0; background: #fff; border: 1px solid #c8c8c8; border-radius: 4px; overflow: hidden }
figure img { width: 100%; display: block }
figcaption { padding: .5rem .7rem } figcaption p { margin: .2rem 0 }
.simulation { background: #fff3d6; border-left: 4px solid #a15c00; padding: .2rem .5rem }
.failed { border: 2px solid #b3261e } .failed b { color: #b3261e }
.missing { padding: 2.5rem .7rem; text-align: center; background: #eee }
.small { font-size: .85rem; color: #4a4a4a }
</style>
)";

// JPEG is read quickest, but stands upright by its tag alone.
std::optional<std::string> ThumbnailOf(const fs::path& stem) {
  fs::path jpeg = stem, png = stem;
  jpeg += ".jpg";
  png += ".png";
  try {
    if (fs::exists(jpeg) && ReadOrientation(jpeg) == 1)
      return PhotoThumbnail(jpeg, kThumbnailWidth);
    if (fs::exists(png)) return PhotoThumbnail(png, kThumbnailWidth);
  } catch (const InputError&) {  // then it is only named
  }
  return std::nullopt;
}

std::string Paragraph(const std::string& of_class, const std::string& text) {
  return "<p" + (of_class.empty() ? "" : " class=\"" + of_class + "\"") + ">" + HtmlText(text) +
         "</p>\n";
}

std::string WhatIsShown(const BatchJob& job) {
  std::string shown = job.variant.empty() ? "building" : job.variant;
  shown += job.hour.empty() ? ", the photograph's light" : ", hour " + job.hour;
  return shown + ", " + job.quality;
}

// A name within a link: all but letters, digits and some marks as codes.
std::string LinkText(const std::string& name) {
  std::string link;
  for (const unsigned char c : name) {
    const bool is_plain =
        std::isalnum(c) != 0 || std::string_view("-._~/@").find(c) != std::string_view::npos;
    link += is_plain ? std::string(1, static_cast<char>(c)) : Formatted("%%%02X", c);
  }
  return link;
}

// What stands above the caption.
std::string PictureOf(const BatchPlan& plan, const SheetEntry& entry) {
  if (!entry.is_done) return "<div class=\"missing\">no picture</div>\n";
  const std::string stem = entry.job.PathsIn(plan.site).montage(entry.job.view).string();
  const std::string link = LinkText(entry.job.Name() + ".png");
  const auto thumbnail = ThumbnailOf(stem);
  if (!thumbnail) {
    return "<div class=\"missing\"><a href=\"" + link + "\">the picture</a></div>\n";
  }
  return "<a href=\"" + link + "\"><img alt=\"" + HtmlText(entry.job.Name()) + "\" src=\"" +
         *thumbnail + "\"></a>\n";
}

std::string CardOf(const BatchPlan& plan, const SheetEntry& entry) {
  const bool has_failed = !entry.is_done && !entry.fault.empty();
  std::string card = has_failed ? "<figure class=\"failed\">\n" : "<figure>\n";
  card += PictureOf(plan, entry) + "<figcaption><b>" + HtmlText(entry.job.Name()) + "</b>\n";
  card += Paragraph("", WhatIsShown(entry.job));
  if (!entry.simulation.empty()) card += Paragraph("simulation", entry.simulation);
  if (entry.is_done) card += Paragraph("small", "rendered in " + Number("%.1f s", entry.seconds));
  if (has_failed) card += "<p><b>failed:</b> " + HtmlText(entry.fault) + "</p>\n";
  if (!entry.is_done && !has_failed) card += Paragraph("", "not rendered yet");
  for (const std::string& warning : entry.warnings) card += Paragraph("small", warning);
  return card + "</figcaption></figure>\n";
}

std::string SummaryOf(const std::vector<SheetEntry>& entries) {
  size_t done = 0, failed = 0, simulated = 0;
  double seconds = 0;
  for (const SheetEntry& entry : entries) {
    done += entry.is_done;
    failed += !entry.is_done && !entry.fault.empty();
    simulated += !entry.simulation.empty();
    if (entry.is_done) seconds += entry.seconds;
  }
  std::string text = std::to_string(done) + " of " + std::to_string(entries.size()) +
                     " pictures, rendered in " + DurationText(seconds) + " together";
  if (failed > 0) text += "; " + std::to_string(failed) + " failed";
  if (simulated > 0) {
    text +=
        "; " + std::to_string(simulated) + " in simulated daylight, which is not the photograph's";
  }
  return text;
}

}  // namespace

std::string ContactSheet(const BatchPlan& plan, const std::vector<SheetEntry>& entries) {
  const std::string title = HtmlText("Contact sheet: " + plan.name());
  std::string page = std::string(kHead) + "<title>" + title + "</title></head><body>\n<h1>" +
                     title + "</h1>\n" + Paragraph("", SummaryOf(entries));
  std::optional<std::string> view;
  for (const SheetEntry& entry : entries) {
    if (view != entry.job.view) {
      page += (view ? "</div>\n" : "") + ("<h2>" + HtmlText(entry.job.view)) +
              "</h2>\n<div class=\"cards\">\n";
      view = entry.job.view;
    }
    page += CardOf(plan, entry);
  }
  return page + (view ? "</div>\n" : "") + Paragraph("small", "insitu " INSITU_VERSION) +
         "</body></html>\n";
}

}  // namespace insitu
