// SPDX-License-Identifier: GPL-3.0-or-later
// Bad input, said so that pages can word it in their language.
#pragma once

#include "calibration/files/sentence.h"

namespace insitu {

// what() is "file:line: message" in English.
SaidError ErrorAt(const FilePlace& place, const Sentence& message);

// What an error says, without the place that an ErrorAt has before it.
Sentence MessageOf(const std::exception& error);

}  // namespace insitu
