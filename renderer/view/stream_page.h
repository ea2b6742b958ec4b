// SPDX-License-Identifier: GPL-3.0-or-later
// `insitu view -` on the page: the picture that comes out of a pipe, tile by tile.
#pragma once

#include <functional>
#include <istream>
#include <memory>
#include <string>

#include "renderer/view/page_server.h"

namespace insitu {

// Reads `input` in a thread of its own until it ends; what came stays to be looked at. Answers as
// the server of a site does (view_server.h), of a single picture that no render can be begun of:
// /api/site says so by `stream`, and by `fault` what is wrong with the stream.
std::unique_ptr<PageService> MakeStreamService(std::istream* input,
                                               std::function<void(std::string)> send);

}  // namespace insitu
