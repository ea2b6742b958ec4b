// SPDX-License-Identifier: GPL-3.0-or-later
// Random bits that are a function of a number alone: the same on every machine, in any order.
#pragma once

#include <cstdint>

namespace insitu {

// One step of SplitMix64 [Steele, Lea & Flood 2014]: every bit of the result hangs on all of
// `state`.
inline uint64_t SplitMix64(uint64_t state) {
  state += 0x9e3779b97f4a7c15u;
  state = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9u;
  state = (state ^ (state >> 27)) * 0x94d049bb133111ebu;
  return state ^ (state >> 31);
}

}  // namespace insitu
