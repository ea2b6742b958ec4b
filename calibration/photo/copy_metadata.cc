// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/copy_metadata.h"

#include <zlib.h>

#include <exiv2/exiv2.hpp>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "calibration/files/error.h"
#include "calibration/files/raw_ending.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr char kNamespace[] = "http://insitu.example/ns/montage/1.0/";
constexpr char kComposite[] = "http://cv.iptc.org/newscodes/digitalsourcetype/compositeSynthetic";
constexpr size_t kMostXmpInJpeg = 65000;  // a segment has 65 533 bytes with its name and padding

struct Metadata {
  Exiv2::ExifData exif;
  Exiv2::XmpData xmp;
  Exiv2::IptcData iptc;
  std::string profile;
};

void Erase(Exiv2::ExifData* exif, const char* key) {
  const auto entry = exif->findKey(Exiv2::ExifKey(key));
  if (entry != exif->end()) exif->erase(entry);
}

Metadata ReadMetadata(const fs::path& source) {
  const auto image = Exiv2::ImageFactory::open(source.string());
  image->readMetadata();
  Metadata read{image->exifData(), image->xmpData(), image->iptcData(), {}};
  if (image->iccProfileDefined()) {
    read.profile.assign(reinterpret_cast<const char*>(image->iccProfile()->pData_),
                        image->iccProfile()->size_);
  }
  Exiv2::ExifThumb(read.exif).erase();
  // A TIFF has these among its EXIF; they are copied by themselves.
  for (const char* key : {"Exif.Image.XMLPacket", "Exif.Image.IPTCNAA", "Exif.Image.ImageResources",
                          "Exif.Image.InterColorProfile"}) {
    Erase(&read.exif, key);
  }
  return read;
}

// "Xmp.photoshop.DocumentAncestors" of "Xmp.photoshop.DocumentAncestors[1]".
std::string TopOf(const std::string& key) { return key.substr(0, key.find_first_of("[/")); }

void EraseXmp(Exiv2::XmpData* xmp, const std::function<bool(const Exiv2::Xmpdatum&)>& is_gone) {
  for (auto entry = xmp->begin(); entry != xmp->end();) {
    entry = is_gone(*entry) ? xmp->erase(entry) : entry + 1;
  }
}

// A gain map for HDR screens lies behind the photograph's picture and is not delivered.
bool SpeaksOfGainMap(const Exiv2::Xmpdatum& entry) {
  const std::string group = entry.groupName();
  return group == "hdrgm" || group == "HDRGainMap" || group == "Container" || group == "GContainer";
}

// What speaks of the sensor's samples would make a picture a raw file again, what speaks of the
// colours of the camera's own picture would be wrong of ours, which are sRGB.
void LeaveWhatIsOfRaw(Metadata* metadata) {
  static const std::set<std::string> kOfThePicture = {
      "ImageDescription", "Make",   "Model",     "Orientation", "XResolution", "YResolution",
      "ResolutionUnit",   "Artist", "Copyright", "DateTime",    "Software",    "HostComputer"};
  Exiv2::ExifData& exif = metadata->exif;
  for (auto entry = exif.begin(); entry != exif.end();) {
    const std::string group = entry->groupName(), name = entry->tagName();
    const bool is_kept = group == "Image"   ? kOfThePicture.contains(name)
                         : group == "Photo" ? !name.starts_with("Pixel") && name != "MakerNote"
                                            : group == "GPSInfo";
    entry = is_kept ? std::next(entry) : exif.erase(entry);
  }
  if (!exif.empty()) exif["Exif.Photo.ColorSpace"] = uint16_t{1};
  metadata->profile.clear();
}

void MakeUpright(Metadata* metadata) {
  for (const char* key : {"Exif.Photo.PixelXDimension", "Exif.Photo.PixelYDimension"}) {
    Erase(&metadata->exif, key);
  }
  const auto entry = metadata->exif.findKey(Exiv2::ExifKey("Exif.Image.Orientation"));
  if (entry != metadata->exif.end()) entry->setValue("1");
  EraseXmp(&metadata->xmp,
           [](const Exiv2::Xmpdatum& xmp) { return xmp.key() == "Xmp.tiff.Orientation"; });
}

// Beside what the photograph states; of its own source only the picture's goes before.
void Add(const MontageStatement& statement, Exiv2::XmpData* xmp) {
  Exiv2::XmpProperties::registerNs(kNamespace, "insitu");
  const auto set = [&](const char* name, const std::string& value) {
    if (!value.empty()) (*xmp)[std::string("Xmp.insitu.") + name] = value;
  };
  set("Program", statement.program);
  set("Computed", statement.computed);
  set("PhotographSha256", statement.photograph_sha256);
  set("ModelSha256", statement.model_sha256);
  set("SurveySha256", statement.survey_sha256);
  set("Simulation", statement.simulation);
  set("Quality", statement.quality);
  set("Parameters", statement.parameters);
  if (!statement.is_composite) return;
  const auto source = xmp->findKey(Exiv2::XmpKey("Xmp.iptcExt.DigitalSourceType"));
  if (source != xmp->end()) set("PhotographDigitalSourceType", source->toString());
  (*xmp)["Xmp.iptcExt.DigitalSourceType"] = std::string(kComposite);
}

size_t PacketSize(const Exiv2::XmpData& xmp) {
  std::string packet;
  Exiv2::XmpParser::encode(packet, xmp, Exiv2::XmpParser::useCompactFormat);
  return packet.size();
}

// The largest property, of those that are not ours; nullopt: there is no other.
std::optional<std::string> LargestProperty(const Exiv2::XmpData& xmp) {
  std::map<std::string, size_t> sizes;
  for (const auto& entry : xmp) {
    const std::string top = TopOf(entry.key());
    if (!top.starts_with("Xmp.insitu.") && top != "Xmp.iptcExt.DigitalSourceType") {
      sizes[top] += entry.key().size() + entry.toString().size();
    }
  }
  std::optional<std::string> largest;
  for (const auto& [top, size] : sizes) {
    if (!largest || size > sizes[*largest]) largest = top;
  }
  return largest;
}

void FitIntoJpeg(Exiv2::XmpData* xmp, std::vector<std::string>* remarks) {
  while (PacketSize(*xmp) > kMostXmpInJpeg) {
    const auto largest = LargestProperty(*xmp);
    if (!largest) return;
    EraseXmp(xmp, [&](const Exiv2::Xmpdatum& entry) { return TopOf(entry.key()) == *largest; });
    remarks->push_back("its XMP does not fit into a JPEG (64 kB): " + *largest + " is left out");
  }
}

// What was wrong, if it was.
std::optional<std::string> Attempt(const fs::path& target,
                                   const std::function<void(Exiv2::Image&)>& set) {
  try {
    const auto image = Exiv2::ImageFactory::open(target.string());
    image->readMetadata();
    set(*image);
    image->writeMetadata();
    return std::nullopt;
  } catch (const Exiv2::Error& error) {
    return error.what();
  }
}

void CopyProfile(const Metadata& metadata, const fs::path& target,
                 std::vector<std::string>* remarks) {
  if (metadata.profile.empty()) return;
  const auto fault = Attempt(target, [&](Exiv2::Image& image) {
    Exiv2::DataBuf profile(reinterpret_cast<const Exiv2::byte*>(metadata.profile.data()),
                           static_cast<long>(metadata.profile.size()));
    image.setIccProfile(profile, false);
  });
  if (fault) remarks->push_back("its ICC profile is left out: " + *fault);
}

// The maker's own notes are what may be too large.
void CopyExif(const Metadata& metadata, const fs::path& target, std::vector<std::string>* remarks) {
  if (metadata.exif.empty()) return;
  Exiv2::ExifData exif = metadata.exif;
  const auto write = [&] {
    return Attempt(target, [&](Exiv2::Image& image) { image.setExifData(exif); });
  };
  if (!write()) return;
  for (auto entry = exif.begin(); entry != exif.end();) {
    const bool is_large = entry->size() > 4096 || entry->key() == "Exif.Photo.MakerNote" ||
                          Exiv2::ExifTags::isMakerGroup(entry->groupName());
    entry = is_large ? exif.erase(entry) : std::next(entry);
  }
  const auto fault = write();
  remarks->push_back(fault ? "its EXIF is left out: " + *fault
                           : "its EXIF does not fit: the camera maker's notes are left out");
  if (!fault) return;
  exif.clear();
  const auto orientation = metadata.exif.findKey(Exiv2::ExifKey("Exif.Image.Orientation"));
  if (orientation == metadata.exif.end()) return;
  exif.add(*orientation);
  write();
}

std::string BigEndianText(uint32_t value) {
  std::string bytes(4, '\0');
  for (int i = 0; i < 4; ++i) bytes[i] = static_cast<char>(value >> (24 - 8 * i) & 255);
  return bytes;
}

// A chunk eXIf, which viewers heed [PNG 3rd edition, 11.3.4.5]; Exiv2 0.27 writes another.
void AddExifChunk(const Exiv2::ExifData& exif, const fs::path& png) {
  Exiv2::Blob blob;
  Exiv2::ExifParser::encode(blob, Exiv2::littleEndian, exif);
  if (blob.empty()) return;
  std::string chunk = "eXIf" + std::string(blob.begin(), blob.end());
  const uint32_t sum = static_cast<uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(chunk.data()), static_cast<uInt>(chunk.size())));
  chunk = BigEndianText(static_cast<uint32_t>(blob.size())) + chunk + BigEndianText(sum);
  constexpr size_t kAfterHeader = 8 + 25;
  std::string content = ReadWhole(png);
  INSITU_CHECK(content.size() > kAfterHeader);
  WriteWhole(png, content.insert(kAfterHeader, chunk));
}

void CopyTexts(const Metadata& metadata, const fs::path& target,
               std::vector<std::string>* remarks) {
  if (!metadata.xmp.empty()) {
    const auto fault =
        Attempt(target, [&](Exiv2::Image& image) { image.setXmpData(metadata.xmp); });
    if (fault) remarks->push_back("its XMP is left out: " + *fault);
  }
  if (metadata.iptc.empty()) return;
  const auto fault =
      Attempt(target, [&](Exiv2::Image& image) { image.setIptcData(metadata.iptc); });
  if (fault) remarks->push_back("its IPTC is left out: " + *fault);
}

bool MayHoldMetadata(const fs::path& path) {
  if (!fs::is_regular_file(path)) throw InputError(path, "no such file, expected a photograph");
  return Exiv2::ImageFactory::getType(path.string()) != Exiv2::ImageType::none;
}

}  // namespace

std::vector<std::string> CopyMetadata(const fs::path& source, const fs::path& target,
                                      const CopiedMetadata& copied) {
  Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);  // cameras' own oddities are not the user's
  std::vector<std::string> remarks;
  Metadata metadata;
  if (MayHoldMetadata(source)) {
    try {
      metadata = ReadMetadata(source);
      if (HasRawEnding(source)) LeaveWhatIsOfRaw(&metadata);
    } catch (const Exiv2::Error& error) {
      remarks.push_back(std::string("its metadata cannot be read: ") + error.what());
    }
  }
  if (HasRawEnding(source) && metadata.exif.empty()) {
    remarks.push_back("the metadata of its raw photograph cannot be read, and are left out");
  }
  const auto format = Exiv2::ImageFactory::getType(target.string());
  EraseXmp(&metadata.xmp, SpeaksOfGainMap);
  if (!copied.with_orientation) MakeUpright(&metadata);
  if (copied.statement) Add(*copied.statement, &metadata.xmp);
  if (format == Exiv2::ImageType::jpeg) FitIntoJpeg(&metadata.xmp, &remarks);
  if (metadata.profile.empty()) metadata.profile = copied.profile;
  if (copied.with_profile) CopyProfile(metadata, target, &remarks);
  CopyTexts(metadata, target, &remarks);
  if (format == Exiv2::ImageType::png) {
    AddExifChunk(metadata.exif, target);
  } else {
    CopyExif(metadata, target, &remarks);
  }
  return remarks;
}

}  // namespace insitu
