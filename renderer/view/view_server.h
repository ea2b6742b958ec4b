// SPDX-License-Identifier: GPL-3.0-or-later
// The server of the viewing page. All but the page itself wants `Authorization: Bearer TOKEN`.
//
//   GET  /, /view.css, /view/page/NAME.js, /prepare/page/NAME.js   the page
//   GET  /api/site                     {name, photos} (site_pictures.h), running: of a render
//   GET  /api/tile?photo&level&x&y     512 px, PNG of level 0, else JPEG; photo: a picture's number
//   GET  /api/value?photo&x&y          one pixel of a picture: {linear, encoded, ...}
//   GET  /api/outline?photo&frame      outline +- 2 sigma of a photograph by name (outline_band.h)
//   POST /api/difference {before, after}   of two pictures: a picture (site_pictures.h)
//   POST /api/run {photo, quality}     insitu-render of a photograph; goes on where it was stopped
//   POST /api/stop                     ends it when its tiles at work are done
//   GET  /api/live                     WebSocket: render (running_renders.h), pictures (some are
//                                      others than before), run (stages/stage_runs.h)
#pragma once

#include <functional>
#include <string>

#include "calibration/program/site.h"
#include "renderer/view/page_server.h"

namespace insitu {

// Serves until SIGINT, SIGTERM or SIGHUP ends it; `tell` receives the address with its token.
// Writes nothing but what insitu-render does when the page runs it. Throws InputError: no
// photographs, the port is taken.
void ServeView(const SitePaths& site, const ViewOptions& options,
               const std::function<void(const std::string& url)>& tell);

}  // namespace insitu
