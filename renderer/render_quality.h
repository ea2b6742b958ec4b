// SPDX-License-Identifier: GPL-3.0-or-later
// Quick looks: quality is traded for time. [Durisch92, §8]
#pragma once

#include <map>
#include <string>

#include "renderer/render_site.h"

namespace insitu {

enum class Quality { kFast, kDraft, kFinal };

inline const std::map<std::string, Quality> kQualities = {
    {"fast", Quality::kFast}, {"draft", Quality::kDraft}, {"final", Quality::kFinal}};

// Lessens what `options` ask for to what a quality has at most, and names it; kFinal leaves them.
void Lessen(Quality quality, RenderSiteOptions* options);

}  // namespace insitu
