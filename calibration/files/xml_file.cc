// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/xml_file.h"

#include <tinyxml2.h>

#include <algorithm>

#include "calibration/files/text_table.h"

namespace insitu {

struct XmlNode::Document {
  std::filesystem::path path;
  tinyxml2::XMLDocument xml;
};

XmlNode XmlNode::Load(const std::filesystem::path& path) {
  const std::string content = ReadTextFile(path);
  auto document = std::make_shared<Document>();
  document->path = path;
  if (document->xml.Parse(content.data(), content.size()) != tinyxml2::XML_SUCCESS) {
    throw ErrorAt(
        {path, document->xml.ErrorLineNum()},
        Sentence("xmlInvalid", "is not valid XML ({why})", {{"why", document->xml.ErrorName()}}));
  }
  const tinyxml2::XMLElement* root = document->xml.RootElement();
  if (!root) throw ErrorAt({path}, Sentence("xmlNothing", "is not XML: it has no element"));
  return XmlNode(document, root);
}

std::string XmlNode::Name() const { return element_->Name(); }

std::string XmlNode::Text() const {
  std::string text;
  for (auto* child = element_->FirstChild(); child; child = child->NextSibling()) {
    if (child->ToText()) text += child->Value();
  }
  return std::string(TrimmedView(text));
}

double XmlNode::Number() const {
  const auto value = ParseNumber(Text());
  if (!value) {
    throw Error(Sentence("xmlNumber", "\"{text}\", expected a finite number", {{"text", Text()}}));
  }
  return *value;
}

std::vector<double> XmlNode::Numbers() const {
  std::string text = Text();
  std::replace(text.begin(), text.end(), ',', ' ');
  std::vector<double> numbers;
  for (const std::string& word : SplitAtBlanks(text)) {
    const auto value = ParseNumber(word);
    if (!value) {
      throw Error(Sentence("xmlNumbers", "\"{text}\", expected finite numbers", {{"text", word}}));
    }
    numbers.push_back(*value);
  }
  if (numbers.empty()) throw Error(Sentence("xmlNoNumbers", "is empty, expected numbers"));
  return numbers;
}

std::optional<XmlNode> XmlNode::Find(const std::string& name) const {
  const auto* child = element_->FirstChildElement(name.c_str());
  if (!child) return std::nullopt;
  return XmlNode(document_, child);
}

XmlNode XmlNode::At(const std::string& name) const {
  const auto child = Find(name);
  if (!child) throw Error(Sentence("xmlMissing", "<{name}> is missing", {{"name", name}}));
  return *child;
}

std::vector<XmlNode> XmlNode::Children(const std::string& name) const {
  std::vector<XmlNode> children;
  const char* wanted = name.empty() ? nullptr : name.c_str();
  for (auto* child = element_->FirstChildElement(wanted); child;
       child = child->NextSiblingElement(wanted)) {
    children.push_back(XmlNode(document_, child));
  }
  return children;
}

std::vector<XmlNode> XmlNode::Descendants(const std::string& name) const {
  std::vector<XmlNode> found;
  for (const XmlNode& child : Children()) {
    if (child.Name() == name) found.push_back(child);
    const std::vector<XmlNode> deeper = child.Descendants(name);
    found.insert(found.end(), deeper.begin(), deeper.end());
  }
  return found;
}

std::optional<std::string> XmlNode::Attribute(const std::string& name) const {
  const char* value = element_->Attribute(name.c_str());
  if (!value) return std::nullopt;
  return std::string(TrimmedView(value));
}

std::string XmlNode::RequiredAttribute(const std::string& name) const {
  const auto value = Attribute(name);
  if (!value || value->empty()) {
    throw Error(Sentence("xmlNoAttribute", "attribute \"{name}\" is missing", {{"name", name}}));
  }
  return *value;
}

double XmlNode::NumberAttribute(const std::string& name) const {
  const std::string text = RequiredAttribute(name);
  const auto value = ParseNumber(text);
  if (!value) {
    throw Error(Sentence("xmlAttribute", "{name}=\"{text}\", expected a finite number",
                         {{"name", name}, {"text", text}}));
  }
  return *value;
}

InputError XmlNode::Error(const std::string& message) const {
  return InputError(path(), line(), std::string("<").append(Name()).append(">: ").append(message));
}

SaidError XmlNode::Error(const Sentence& message) const {
  return ErrorAt(place(), Sentence("xmlElement", "<{element}>: {message}",
                                   {{"element", Name()}, {"message", message.ToJson()}}));
}

const std::filesystem::path& XmlNode::path() const { return document_->path; }
int XmlNode::line() const { return element_->GetLineNum(); }

}  // namespace insitu
