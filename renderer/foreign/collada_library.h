// SPDX-License-Identifier: GPL-3.0-or-later
// What stands in a COLLADA file under ids, to be found by "#id".
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/files/xml_file.h"

namespace insitu {

class ColladaLibrary {
 public:
  explicit ColladaLibrary(const XmlNode& root);

  // Of an element kind ("geometry", "node", ...) by "#id", or the id alone; nullopt: none.
  std::optional<XmlNode> Find(const std::string& kind, const std::string& url) const;
  // Throws InputError at `user`: none.
  XmlNode At(const std::string& kind, const std::string& url, const XmlNode& user) const;

 private:
  void Add(const XmlNode& element, const std::string& kind);
  std::map<std::pair<std::string, std::string>, XmlNode> elements_;
};

// The numbers of an element's text; what is none is passed over as 0 and counted.
std::vector<double> ColladaNumbers(const XmlNode& element, int* faulty);

// The whole numbers of <p>, <vcount>. Throws InputError at it: none.
std::vector<int> ColladaIndices(const XmlNode& element);

}  // namespace insitu
