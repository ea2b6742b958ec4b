// SPDX-License-Identifier: GPL-3.0-or-later
// A JPEG changed in some places only: everywhere else it keeps its own coefficients.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace insitu {

// Writes `target`, the JPEG `source` with the difference of `changed` and `original` added: codes
// of red, green and blue of its frame, as `source` decodes and as they shall be. Blocks in which
// nothing differs keep their DCT coefficients, all keep quantisation and subsampling [ITU-T T.81];
// of metadata nothing is copied. Where codes of a grey JPEG become coloured, or its components are
// neither grey, RGB nor YCbCr, nothing is written and why not is returned; "" if all went well.
std::string WriteChangedBlocks(const std::filesystem::path& source,
                               const std::vector<uint8_t>& original,
                               const std::vector<uint8_t>& changed,
                               const std::filesystem::path& target);

}  // namespace insitu
