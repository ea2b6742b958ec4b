// SPDX-License-Identifier: GPL-3.0-or-later
// What is wrong with a value of a JSON file, said so that pages word it in their language.
#pragma once

#include "calibration/files/json_file.h"
#include "calibration/files/sentence.h"

namespace insitu {

// An error about a value, to be thrown, as JsonNode::Error.
inline SaidError JsonFault(const JsonNode& node, const Sentence& what) {
  return {node.Error(what.text()), {node.path(), node.line()}, what};
}

}  // namespace insitu
