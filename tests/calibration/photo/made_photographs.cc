// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/calibration/photo/made_photographs.h"

#include <cstdio>
// After what it needs.
#include <jpeglib.h>
#include <lcms2.h>
#include <zlib.h>

#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

cmsCIExyY Xyy(const Eigen::Vector2d& xy) { return {xy.x(), xy.y(), 1}; }

cmsHPROFILE OpenMade(const Primaries& primaries, const TransferFunction& transfer) {
  const double parameters[] = {transfer.g, transfer.a, transfer.b, transfer.c, transfer.d};
  cmsToneCurve* curve = cmsBuildParametricToneCurve(nullptr, 4, parameters);
  cmsToneCurve* const curves[] = {curve, curve, curve};
  const cmsCIExyY white = Xyy(primaries.white);
  const cmsCIExyYTRIPLE corners = {Xyy(primaries.red), Xyy(primaries.green), Xyy(primaries.blue)};
  cmsHPROFILE profile = cmsCreateRGBProfile(&white, &corners, curves);
  cmsFreeToneCurve(curve);
  return profile;
}

std::string Saved(cmsHPROFILE profile) {
  cmsUInt32Number size = 0;
  cmsSaveProfileToMem(profile, nullptr, &size);
  std::string bytes(size, '\0');
  cmsSaveProfileToMem(profile, bytes.data(), &size);
  cmsCloseProfile(profile);
  return bytes;
}

cmsInt32Number SampleLab(const cmsUInt16Number in[], cmsUInt16Number out[], void* transform) {
  cmsDoTransform(transform, in, out, 1);
  return TRUE;
}

}  // namespace

std::string MadeProfile(const Primaries& primaries, const TransferFunction& transfer,
                        double version) {
  cmsHPROFILE profile = OpenMade(primaries, transfer);
  if (version < 4) {
    cmsSetProfileVersion(profile, version);
    cmsToneCurve* gamma = cmsBuildGamma(nullptr, transfer.g);
    for (const auto tag : {cmsSigRedTRCTag, cmsSigGreenTRCTag, cmsSigBlueTRCTag}) {
      cmsWriteTag(profile, tag, gamma);
    }
    cmsFreeToneCurve(gamma);
  }
  return Saved(profile);
}

std::string MadeTableProfile() {
  cmsHPROFILE p3 = OpenMade(kDisplayP3, kSrgbTransfer);
  cmsHPROFILE lab = cmsCreateLab4Profile(nullptr);
  cmsHTRANSFORM transform =
      cmsCreateTransform(p3, TYPE_RGB_16, lab, TYPE_Lab_16, INTENT_RELATIVE_COLORIMETRIC, 0);
  cmsHPROFILE profile = cmsCreateProfilePlaceholder(nullptr);
  cmsSetProfileVersion(profile, 4.2);
  cmsSetDeviceClass(profile, cmsSigInputClass);
  cmsSetColorSpace(profile, cmsSigRgbData);
  cmsSetPCS(profile, cmsSigLabData);
  cmsPipeline* pipeline = cmsPipelineAlloc(nullptr, 3, 3);
  cmsStage* table = cmsStageAllocCLut16bit(nullptr, 17, 3, 3, nullptr);
  cmsStageSampleCLut16bit(table, SampleLab, transform, 0);
  cmsPipelineInsertStage(pipeline, cmsAT_END, cmsStageAllocToneCurves(nullptr, 3, nullptr));
  cmsPipelineInsertStage(pipeline, cmsAT_END, table);
  cmsPipelineInsertStage(pipeline, cmsAT_END, cmsStageAllocToneCurves(nullptr, 3, nullptr));
  cmsWriteTag(profile, cmsSigAToB0Tag, pipeline);
  cmsPipelineFree(pipeline);
  cmsDeleteTransform(transform);
  cmsCloseProfile(lab);
  cmsCloseProfile(p3);
  return Saved(profile);
}

std::string MadeGreyProfile(double gamma) {
  const cmsCIExyY white = Xyy(kRec709.white);
  cmsToneCurve* curve = cmsBuildGamma(nullptr, gamma);
  const std::string bytes = Saved(cmsCreateGrayProfile(&white, curve));
  cmsFreeToneCurve(curve);
  return bytes;
}

std::string MadeLinkProfile() {
  cmsToneCurve* curve = cmsBuildGamma(nullptr, 2);
  cmsToneCurve* const curves[] = {curve, curve, curve};
  const std::string bytes = Saved(cmsCreateLinearizationDeviceLink(cmsSigRgbData, curves));
  cmsFreeToneCurve(curve);
  return bytes;
}

std::string MadeCmykProfile() {
  cmsHPROFILE profile = cmsCreateProfilePlaceholder(nullptr);
  cmsSetDeviceClass(profile, cmsSigOutputClass);
  cmsSetColorSpace(profile, cmsSigCmykData);
  cmsSetPCS(profile, cmsSigLabData);
  return Saved(profile);
}

void WriteCmykJpeg(const std::filesystem::path& path) {
  jpeg_compress_struct codec = {};
  jpeg_error_mgr errors;
  codec.err = jpeg_std_error(&errors);
  jpeg_create_compress(&codec);
  std::FILE* file = std::fopen(path.c_str(), "wb");
  jpeg_stdio_dest(&codec, file);
  codec.image_width = codec.image_height = 8;
  codec.input_components = 4;
  codec.in_color_space = JCS_CMYK;
  jpeg_set_defaults(&codec);
  jpeg_start_compress(&codec, TRUE);
  std::vector<JSAMPLE> row(32, 200);
  JSAMPROW rows[] = {row.data()};
  for (int y = 0; y < 8; ++y) jpeg_write_scanlines(&codec, rows, 1);
  jpeg_finish_compress(&codec);
  jpeg_destroy_compress(&codec);
  std::fclose(file);
}

std::string ChunkInteger(uint32_t value) {
  std::string bytes(4, '\0');
  for (int i = 0; i < 4; ++i) bytes[i] = static_cast<char>(value >> (24 - 8 * i) & 255);
  return bytes;
}

void InsertChunk(const std::filesystem::path& png, const std::string& name,
                 const std::string& content, size_t at) {
  const std::string body = name + content;
  const auto sum = static_cast<uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size())));
  std::string file = ReadWhole(png);
  file.insert(at, ChunkInteger(static_cast<uint32_t>(content.size())) + body + ChunkInteger(sum));
  WriteWhole(png, file);
}

std::string Deflated(const std::string& text) {
  uLongf size = compressBound(static_cast<uLong>(text.size()));
  std::string bytes(size, '\0');
  compress(reinterpret_cast<Bytef*>(bytes.data()), &size,
           reinterpret_cast<const Bytef*>(text.data()), static_cast<uLong>(text.size()));
  bytes.resize(size);
  return bytes;
}

std::vector<uint16_t> P3FromSrgb(const std::vector<uint16_t>& srgb) {
  cmsHPROFILE from = OpenMade(kRec709, kSrgbTransfer), to = OpenMade(kDisplayP3, kSrgbTransfer);
  cmsHTRANSFORM transform = cmsCreateTransform(from, TYPE_RGB_16, to, TYPE_RGB_16,
                                               INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOOPTIMIZE);
  std::vector<uint16_t> p3(srgb.size());
  cmsDoTransform(transform, srgb.data(), p3.data(), static_cast<cmsUInt32Number>(srgb.size() / 3));
  cmsDeleteTransform(transform);
  cmsCloseProfile(from);
  cmsCloseProfile(to);
  return p3;
}

}  // namespace insitu
