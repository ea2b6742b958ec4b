// SPDX-License-Identifier: GPL-3.0-or-later
// The server of the measuring page. All but the page itself wants `Authorization: Bearer TOKEN`.
//
//   GET  /, /page.css, /page/NAME.js   the page
//   GET  /api/site                     tables, photographs, history, newest results, what to do
//   GET  /api/tile?photo&level&x&y     JPEG, 512 px; photo is an index
//   GET  /api/patch?photo&x&y&r        PNG, lossless
//   GET  /api/value?photo&x&y          one pixel
//   GET  /api/relit?photo&light        light: none, sun; 202 until it is made (relit_photos.h)
//   GET  /api/relit_picture?...        then its JPEG
//   POST /api/op                       an operation (operation.h): 200 {revision}, 409 {conflicts}
//   POST /api/undo, /api/redo {id}     200 {revision, operation}
//   POST /api/epipolar, /api/measure, /api/best_photo, /api/polygon_at, /api/import   questions.h
//   POST /api/refine {photo, x, y, fiducial}, /api/match {photo, point}    mark_proposal.h
//   POST /api/run {stage, label}       runs a stage, or exif-camera or exif-site, which are in
//                                      site_from_exif.h
//   POST /api/stop                     the stage that runs
//   GET  /api/live                     WebSocket: op, saved, not_saved, adjusted, light, building,
//                                      film (film_message.h), todo, run, outside, fault
#pragma once

#include <functional>
#include <string>

#include "calibration/program/site.h"

namespace insitu {

struct PrepareOptions {
  int port = 0;  // 0: the site's last one, else any that is free
  bool opens_browser = true;
};

// Receives the address with its token.
using TellAddress = std::function<void(const std::string& url)>;
// Receives what people at the terminal must know, in English, from any thread.
using Warn = std::function<void(const std::string& text)>;

// Serves until a signal ends it: SIGINT, SIGTERM, SIGHUP. What was confirmed is then in the
// survey's files. Without a port asked for, the site's last one is taken if it is free, for what a
// page could not send stands in the browser under its address. Throws InputError: no photographs,
// another server has the site, the port is taken.
void ServePrepare(const SitePaths& site, const PrepareOptions& options, const TellAddress& tell,
                  const Warn& warn);

}  // namespace insitu
