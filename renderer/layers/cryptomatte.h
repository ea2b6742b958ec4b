// SPDX-License-Identifier: GPL-3.0-or-later
// Which things a pixel shows and how much of it each covers, by the hash of their names.
// [Friedman, Jones 2015; Cryptomatte specification 1.2.0]
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace insitu {

// MurmurHash3, x86, 32 bits, seed 0. [Appleby, public domain]
uint32_t MurmurHash3(std::string_view text);

// The number that stands for a name: its hash taken as a float, changed in one bit of its exponent
// where that would be no number.
float CryptomatteId(std::string_view name);

constexpr int kCryptomatteRanks = 4;

// Shares of one pixel by index into `ids` -> ranks of (id, share), the largest first, zeros where
// there are fewer. Of more than kCryptomatteRanks the smallest are left out.
std::vector<float> CryptomatteRanks(const std::map<int, double>& shares,
                                    const std::vector<float>& ids);

// {"name": "8 hexadecimal digits of its id", ...}
std::string CryptomatteManifest(const std::vector<std::string>& names);

// The first seven digits of the hash of a matte's own name, as its metadata are keyed.
std::string CryptomatteKey(std::string_view matte);

}  // namespace insitu
