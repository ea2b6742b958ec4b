// SPDX-License-Identifier: GPL-3.0-or-later
// Rows in which a colleague's copy of the site differs, kept (work/prepare/merge.json) until
// somebody has decided on the page which version stands.
#pragma once

#include <json/value.h>

#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "reconstruction/editing/site_edit.h"

namespace insitu {

// Adds them to those that wait already. Throws InputError if it cannot be written.
void KeepMergeConflicts(const SitePaths& site, const SitePaths& colleague,
                        const std::vector<RowConflict>& conflicts);

// Those whose row still stands as it did: [{from, table, before, current, after}], `current` ours.
Json::Value OpenMergeConflicts(const SitePaths& site, const SiteEdit& edit);

// It is decided: none like it is kept any more.
void DropMergeConflict(const SitePaths& site, const Json::Value& conflict);

}  // namespace insitu
