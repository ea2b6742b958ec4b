// SPDX-License-Identifier: GPL-3.0-or-later
// What all jobs of a plan need before the first begins: designs converted, hours relit.
#pragma once

#include <filesystem>
#include <vector>

#include "renderer/batch/batch_jobs.h"
#include "renderer/batch/batch_plan.h"

namespace insitu {

// As far as their results do not hold. Fills `jobs`, with the hashes of their inputs. Status as of
// a program. Throws InputError: the site's light is not measured yet, an hour whose light cannot be
// simulated; nothing was done then.
int PrepareBatch(const BatchPlan& plan, const std::filesystem::path& programs, FileHashes* hashes,
                 std::vector<BatchJob>* jobs);

}  // namespace insitu
