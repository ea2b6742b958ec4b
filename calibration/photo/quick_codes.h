// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures that are to be there soon rather than small.
#pragma once

#include <filesystem>

namespace insitu {

struct CodedPhotograph;

// As WriteCodes (photograph.h), but an EXR is not packed at all and a PNG a little.
void WriteCodesQuickly(const std::filesystem::path& path, const CodedPhotograph& picture);

}  // namespace insitu
