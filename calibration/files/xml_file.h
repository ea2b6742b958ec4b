// SPDX-License-Identifier: GPL-3.0-or-later
// Reading XML so that every fault can name its file and line, as json_file.h does for JSON.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibration/files/error_at.h"

namespace tinyxml2 {
class XMLElement;
}

namespace insitu {

// An element. Accessors throw InputError at the element's line when it is not what is asked for.
class XmlNode {
 public:
  static XmlNode Load(const std::filesystem::path& path);  // the root element

  std::string Name() const;
  std::string Text() const;             // of its own, trimmed; may be empty
  double Number() const;                // finite
  std::vector<double> Numbers() const;  // by commas or blanks; at least one, finite

  std::optional<XmlNode> Find(const std::string& name) const;  // its first child of that name
  XmlNode At(const std::string& name) const;                   // must exist
  std::vector<XmlNode> Children(const std::string& name = {}) const;  // all, or of that name
  std::vector<XmlNode> Descendants(const std::string& name) const;    // in the file's order

  std::optional<std::string> Attribute(const std::string& name) const;
  std::string RequiredAttribute(const std::string& name) const;
  double NumberAttribute(const std::string& name) const;  // must exist, finite

  // An error about this element, to be thrown.
  InputError Error(const std::string& message) const;
  SaidError Error(const Sentence& message) const;
  const std::filesystem::path& path() const;
  int line() const;
  FilePlace place() const { return {path(), line()}; }

 private:
  struct Document;
  XmlNode(std::shared_ptr<const Document> document, const tinyxml2::XMLElement* element)
      : document_(std::move(document)), element_(element) {}
  std::shared_ptr<const Document> document_;
  const tinyxml2::XMLElement* element_;
};

}  // namespace insitu
