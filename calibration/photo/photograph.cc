// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/photograph.h"

#include <OpenImageIO/imageio.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "calibration/color/response.h"
#include "calibration/color/srgb_table.h"
#include "calibration/color/stated_color.h"
#include "calibration/files/error.h"
#include "calibration/files/error_at.h"
#include "calibration/files/raw_ending.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/copy_metadata.h"
#include "calibration/photo/quick_codes.h"
#include "calibration/photo/raw_photograph.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

// A header may claim what would not fit into memory.
constexpr int64_t kMostPixels = int64_t{1} << 29;

std::unique_ptr<ImageInput> OpenAs(const fs::path& path, bool as_stored) {
  ImageSpec config;
  config.attribute("oiio:RawColor", as_stored ? 1 : 0);  // the codes as they stand in the file,
  config.attribute("oiio:UnassociatedAlpha", 1);         // not multiplied by alpha
  auto input = ImageInput::open(path.string(), &config);
  if (!input) {
    throw ErrorAt({path}, Sentence("photoUnreadable", "not a readable image: {why}",
                                   {{"why", FirstLine(OIIO::geterror())}}));
  }
  return input;
}

// [TIFF 6.0, PhotometricInterpretation]; -1: no TIFF.
int PhotometricOf(const ImageSpec& spec) {
  return spec.get_int_attribute("tiff:PhotometricInterpretation", -1);
}

// What the channels are, where they are not grey or RGB.
std::string StrangeColors(const ImageInput& input) {
  const ImageSpec& spec = input.spec();
  const int photometric = PhotometricOf(spec);
  const std::string format = input.format_name();
  if (photometric == 5 || (format == "jpeg" && spec.nchannels == 4)) return "CMYK";
  if (photometric >= 8 && photometric <= 10) return "CIELab";
  if (photometric > 10) {
    return "a TIFF of photometric interpretation " + std::to_string(photometric);
  }
  if (format != "openexr" || spec.nchannels < 3) return "";
  for (int c = 0; c < 3; ++c) {
    const std::string& name = spec.channelnames[c];
    if (name.empty() || std::toupper(static_cast<unsigned char>(name.back())) != "RGB"[c]) {
      return "an EXR of channels " + spec.channelnames[0] + ", " + spec.channelnames[1] + ", " +
             spec.channelnames[2];
    }
  }
  return "";
}

std::unique_ptr<ImageInput> Open(const fs::path& path) {
  if (!fs::is_regular_file(path)) {
    throw ErrorAt({path}, Sentence("photoGone", "no such file, expected a photograph"));
  }
  auto input = OpenAs(path, true);
  if (PhotometricOf(input->spec()) == 6) input = OpenAs(path, false);  // YCbCr
  const ImageSpec& spec = input->spec();
  if (int64_t{spec.width} * spec.height > kMostPixels) {
    throw ErrorAt({path}, Sentence("photoLarge",
                                   "is {size}, expected at most 536 megapixels; make it smaller",
                                   {{"size", SizeText(spec.width, spec.height)}}));
  }
  if (const std::string colors = StrangeColors(*input); !colors.empty()) {
    throw ErrorAt({path},
                  Sentence("photoColors", "is {colors}, expected RGB or grey; convert it to sRGB",
                           {{"colors", colors}}));
  }
  return input;
}

template <typename Element>
std::vector<Element> ArrayOf(const ImageSpec& spec, const char* name) {
  const OIIO::ParamValue* value = spec.find_attribute(name);
  if (!value || value->type().elementtype() != OIIO::BaseTypeFromC<Element>::value) return {};
  const auto* first = static_cast<const Element*>(value->data());
  return {first, first + value->type().basevalues()};
}

ColorSpace ColorOf(const ImageInput& input, const fs::path& path) {
  const ImageSpec& spec = input.spec();
  DecodedHeader header;
  header.channels = spec.nchannels < 3 ? 1 : 3;
  header.is_float = spec.format == TypeDesc::FLOAT || spec.format == TypeDesc::HALF;
  if (PhotometricOf(spec) >= 0) {
    const auto profile = ArrayOf<unsigned char>(spec, "ICCProfile");
    header.profile.assign(profile.begin(), profile.end());
  }
  if (std::string(input.format_name()) == "openexr") {
    header.chromaticities = ArrayOf<float>(spec, "chromaticities");
  }
  return ReadStatedColor(path, header);
}

Encoding EncodingOf(const ImageSpec& spec, const fs::path& path) {
  switch (spec.format.basetype) {
    case TypeDesc::UINT8:
      return Encoding::kSrgb8;
    case TypeDesc::UINT16:
      return Encoding::kSrgb16;
    case TypeDesc::HALF:
    case TypeDesc::FLOAT:
      return Encoding::kLinear;
    default:
      throw ErrorAt({path}, Sentence("photoType",
                                     "pixels of type {type}, expected 8 or 16 bits, half or float",
                                     {{"type", spec.format.c_str()}}));
  }
}

// All channels, interleaved. Decoders may only warn of a file cut short: a message is a failure.
template <typename Sample>
std::vector<Sample> ReadSamples(ImageInput& input, const fs::path& path) {
  const ImageSpec& spec = input.spec();
  std::vector<Sample> samples(static_cast<size_t>(spec.width) * spec.height * spec.nchannels);
  const bool complete =
      input.read_image(0, 0, 0, spec.nchannels, OIIO::BaseTypeFromC<Sample>::value, samples.data());
  if (!complete || input.has_error()) {
    throw ErrorAt({path}, Sentence("photoDamaged", "cut short or damaged: {why}",
                                   {{"why", FirstLine(input.geterror())}}));
  }
  return samples;
}

// The first three channels; one or two channels are grey (and alpha).
template <typename Sample>
std::vector<Sample> ReadThreeChannels(ImageInput& input, const fs::path& path) {
  std::vector<Sample> samples = ReadSamples<Sample>(input, path);
  const int channels = input.spec().nchannels;
  if (channels == 3) return samples;
  const bool is_grey = channels < 3;
  std::vector<Sample> three(samples.size() / channels * 3);
  for (size_t i = 0; i * 3 < three.size(); ++i) {
    for (int c = 0; c < 3; ++c) three[3 * i + c] = samples[i * channels + (is_grey ? 0 : c)];
  }
  return three;
}

// What stands for 1.
template <typename Sample>
constexpr double Highest() {
  return std::is_floating_point_v<Sample> ? 1 : std::numeric_limits<Sample>::max();
}

template <typename Sample>
Raster DecodedByDefault(const CodedPhotograph& photo, std::vector<Sample>& samples) {
  Raster raster(photo.width, photo.height);
  if constexpr (std::is_floating_point_v<Sample>) {
    raster.data = std::move(samples);
  } else {
    const std::vector<float>& table = LinearTable<Sample>();
    std::transform(samples.begin(), samples.end(), raster.data.begin(),
                   [&](Sample code) { return table[code]; });
  }
  return raster;
}

// Takes the samples.
template <typename Sample>
Raster Decoded(const CodedPhotograph& photo, std::vector<Sample>& samples) {
  if (photo.color.IsDefault()) return DecodedByDefault(photo, samples);
  Raster raster(photo.width, photo.height);
  tbb::parallel_for(0, photo.height, [&](int y) {
    const Sample* code = &samples[static_cast<size_t>(y) * photo.width * 3];
    for (int x = 0; x < photo.width; ++x, code += 3) {
      const Eigen::Vector3d encoded(code[0], code[1], code[2]);
      raster.SetRgb(x, y, photo.color.Linear(encoded / Highest<Sample>()));
    }
  });
  return raster;
}

void CheckFinite(const std::vector<float>& values, int width, const fs::path& path) {
  const auto strange =
      std::find_if(values.begin(), values.end(), [](float value) { return !std::isfinite(value); });
  if (strange == values.end()) return;
  const auto pixel = (strange - values.begin()) / 3;
  throw ErrorAt(
      {path},
      Sentence("photoNotFinite", "pixel ({x}, {y}) is NaN or infinite, expected finite values",
               {{"x", static_cast<int>(pixel % width)}, {"y", static_cast<int>(pixel / width)}}));
}

// The nearest code; NaN becomes 0.
template <typename Code>
Code NearestCode(double encoded) {
  const double clamped = encoded > 0 ? std::min(encoded, 1.0) : 0.0;
  return static_cast<Code>(std::lround(Highest<Code>() * clamped));
}

// The default's, of one channel.
template <typename Code>
Code Encoded(float linear) {
  if constexpr (std::is_same_v<Code, uint8_t>) return NearestSrgbCode(linear);
  return NearestCode<Code>(SrgbFromLinear(linear));
}

template <typename Code>
void EncodeRow(const Raster& linear, int y, const ColorSpace& color,
               const std::function<bool(int, int)>& is_wanted, Code* codes) {
  for (int x = 0; x < linear.width; ++x, codes += 3) {
    if (is_wanted && !is_wanted(x, y)) continue;
    if constexpr (std::is_floating_point_v<Code>) {
      const Eigen::Vector3d encoded = color.conversion->Encoded(linear.Rgb(x, y));
      for (int c = 0; c < 3; ++c) codes[c] = static_cast<Code>(encoded[c]);
    } else if (color.IsDefault()) {
      for (int c = 0; c < 3; ++c) codes[c] = Encoded<Code>(linear.At(x, y)[c]);
    } else {
      const Eigen::Vector3d encoded = color.Encoded(linear.Rgb(x, y));
      for (int c = 0; c < 3; ++c) codes[c] = NearestCode<Code>(encoded[c]);
    }
  }
}

Raster InThreeChannels(const Raster& grey) {
  Raster three(grey.width, grey.height);
  for (size_t i = 0; i < grey.data.size(); ++i) {
    for (int c = 0; c < 3; ++c) three.data[3 * i + c] = grey.data[i];
  }
  return three;
}

template <typename Code>
std::vector<Code> EncodedCodes(const Raster& linear, const ColorSpace& color,
                               const std::function<bool(int, int)>& is_wanted) {
  INSITU_CHECK(linear.channels == 3);
  if constexpr (std::is_floating_point_v<Code>) {
    if (color.IsDefault()) return linear.data;
  }
  std::vector<Code> codes(linear.data.size());
  tbb::parallel_for(0, linear.height, [&](int y) {
    EncodeRow(linear, y, color, is_wanted, &codes[static_cast<size_t>(y) * linear.width * 3]);
  });
  return codes;
}

template <typename Sample>
void WriteImage(const fs::path& path, ImageSpec spec, const std::vector<Sample>& samples) {
  spec.set_format(OIIO::BaseTypeFromC<Sample>::value);
  const auto output = ImageOutput::create(path.string());
  if (!output) throw std::runtime_error(path.string() + ": " + FirstLine(OIIO::geterror()));
  const bool written = output->open(path.string(), spec) &&
                       output->write_image(spec.format, samples.data()) && output->close();
  if (!written) throw std::runtime_error(path.string() + ": " + FirstLine(output->geterror()));
}

ImageSpec SpecOf(const CodedPhotograph& picture) {
  INSITU_CHECK(picture.width > 0 && picture.height > 0);
  ImageSpec spec(picture.width, picture.height, 3);
  spec.attribute("CompressionQuality", 95);  // a JPEG's
  spec.attribute("jpeg:subsampling", "4:4:4");
  if (const std::string& profile = picture.color.profile; !profile.empty()) {
    spec.attribute("ICCProfile", TypeDesc(TypeDesc::UINT8, static_cast<int>(profile.size())),
                   profile.data());
  }
  return spec;
}

// Its primaries are always stated; the time of writing is not, or it would change the bytes.
void DescribeExr(const std::vector<float>& chromaticities, ImageSpec* spec) {
  constexpr std::array<float, 8> kOfRec709 = {0.64f, 0.33f, 0.30f,   0.60f,
                                              0.15f, 0.06f, 0.3127f, 0.3290f};
  spec->attribute("compression", "zip");
  spec->attribute("DateTime", "");
  spec->attribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8),
                  chromaticities.empty() ? kOfRec709.data() : chromaticities.data());
}

// Of a file of the format of its name's ending.
ImageSpec FileSpecOf(const fs::path& path, const CodedPhotograph& picture) {
  ImageSpec spec = SpecOf(picture);
  const std::string ending = path.extension().string();
  if (ending == ".exr") DescribeExr(picture.color.chromaticities, &spec);
  if (ending == ".tif") {
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", "0000:00:00 00:00:00");
  }
  return spec;
}

}  // namespace

CodedPhotograph ReadCodedPhotograph(const fs::path& path) {
  if (HasRawEnding(path)) {
    RawPhotograph raw = ReadRawPhotograph(path);
    return {raw.width, raw.height, std::move(raw.codes), raw.color};
  }
  const auto input = Open(path);
  CodedPhotograph photo{input->spec().width, input->spec().height, {}, {}};
  const Encoding encoding = EncodingOf(input->spec(), path);
  photo.color = ColorOf(*input, path);
  if (encoding != Encoding::kLinear) photo.color = WithResponseBeside(path, photo.color);
  if (encoding == Encoding::kSrgb8) {
    photo.samples = ReadThreeChannels<uint8_t>(*input, path);
  } else if (encoding == Encoding::kSrgb16) {
    photo.samples = ReadThreeChannels<uint16_t>(*input, path);
  } else {
    auto values = ReadThreeChannels<float>(*input, path);
    CheckFinite(values, photo.width, path);
    photo.samples = std::move(values);
  }
  return photo;
}

Photograph ReadPhotograph(const fs::path& path) {
  CodedPhotograph coded = ReadCodedPhotograph(path);
  Raster linear = std::visit([&](auto& samples) { return Decoded(coded, samples); }, coded.samples);
  return {std::move(linear), static_cast<Encoding>(coded.samples.index()), coded.color};
}

ColorSpace ReadPhotographColor(const fs::path& path) {
  return HasRawEnding(path) ? ReadRawColor(path) : ColorOf(*Open(path), path);
}

CodedPhotograph CodesOf(const Raster& linear, Encoding encoding, const ColorSpace& color,
                        const std::function<bool(int, int)>& is_wanted) {
  if (linear.channels == 1) return CodesOf(InThreeChannels(linear), encoding, color, is_wanted);
  CodedPhotograph picture{linear.width, linear.height, {}, color};
  switch (encoding) {
    case Encoding::kSrgb8:
      picture.samples = EncodedCodes<uint8_t>(linear, color, is_wanted);
      break;
    case Encoding::kSrgb16:
      picture.samples = EncodedCodes<uint16_t>(linear, color, is_wanted);
      break;
    case Encoding::kLinear:
      picture.samples = EncodedCodes<float>(linear, color, is_wanted);
      break;
  }
  return picture;
}

void WriteCodes(const fs::path& path, const CodedPhotograph& picture) {
  const ImageSpec spec = FileSpecOf(path, picture);
  std::visit([&](const auto& samples) { WriteImage(path, spec, samples); }, picture.samples);
}

void WriteCodesQuickly(const fs::path& path, const CodedPhotograph& picture) {
  ImageSpec spec = FileSpecOf(path, picture);
  if (path.extension() == ".exr") spec.attribute("compression", "none");
  if (path.extension() == ".png") spec.attribute("png:compressionLevel", 1);
  std::visit([&](const auto& samples) { WriteImage(path, spec, samples); }, picture.samples);
}

Eigen::Vector2i ReadPhotographSize(const fs::path& path) {
  if (HasRawEnding(path)) return ReadRawSize(path);
  const auto input = Open(path);
  return {input->spec().width, input->spec().height};
}

std::string SizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height) + " px";
}

void RequirePhotographSize(const fs::path& path, int width, int height) {
  const Eigen::Vector2i size = ReadPhotographSize(path);
  if (size == Eigen::Vector2i(width, height)) return;
  throw ErrorAt(
      {path},
      Sentence("photoSize", "is {size}, expected {expected} as its camera was calibrated",
               {{"size", SizeText(size.x(), size.y())}, {"expected", SizeText(width, height)}}));
}

bool IsClipped(const Photograph& photo, int x, int y) {
  if (photo.encoding == Encoding::kLinear) return false;
  const Eigen::Vector3d rgb = photo.linear.Rgb(x, y);
  if (photo.color.IsDefault()) return rgb.maxCoeff() >= 1;
  return photo.color.Encoded(rgb).maxCoeff() >= 1 - 1e-4;  // 0.03 of an 8-bit code for rounding
}

void WriteExr(const fs::path& path, const Raster& linear) {
  const CodedPhotograph picture = CodesOf(linear, Encoding::kLinear, {});
  WriteWhole(path, [&](const fs::path& temporary) { WriteCodes(temporary, picture); });
}

void WritePng(const fs::path& path, const Raster& linear, Encoding encoding) {
  const bool is_8_bit = encoding == Encoding::kSrgb8;
  const CodedPhotograph picture =
      CodesOf(linear, is_8_bit ? Encoding::kSrgb8 : Encoding::kSrgb16, {});
  WriteWhole(path, [&](const fs::path& temporary) { WriteCodes(temporary, picture); });
}

void WriteJpeg(const fs::path& path, const Raster& linear, const fs::path& metadata_source) {
  const CodedPhotograph picture = CodesOf(linear, Encoding::kSrgb8, {});
  WriteWhole(path, [&](const fs::path& temporary) {
    WriteCodes(temporary, picture);
    CopyMetadata(metadata_source, temporary);
  });
}

}  // namespace insitu
