// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/bumps.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "radiometry/library/json_fault.h"
#include "radiometry/light/split_mix.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

constexpr int kWaves = 64;
constexpr double kUsualOctaves = 5;     // below scale_m, if the shortest is not stated
constexpr double kUsualSpreadDeg = 40;  // of waves that the wind drives
constexpr double kRadPerDeg = std::numbers::pi / 180;
constexpr double kGolden = 0.6180339887498949;

double Positive(const JsonNode& node, const Sentence& fault) {
  const double value = node.Number();
  if (value <= 0) throw JsonFault(node, fault);
  return value;
}

Sentence NoLength() { return Sentence("bumpsLength", "is out of range, expected metres above 0"); }

void ReadDirection(const JsonNode& node, Bumps* bumps) {
  const auto direction = node.Find("direction");
  const auto spread = node.Find("spread_deg");
  if (spread && !direction) {
    throw JsonFault(*spread, Sentence("bumpsSpread", "stands without direction"));
  }
  if (!direction) return;
  bumps->direction = direction->Vector3();
  if (bumps->direction->norm() == 0) {
    throw JsonFault(*direction, Sentence("bumpsDirection",
                                         "is zero, expected [x, y, z] in the survey's frame"));
  }
  const double degrees = spread ? spread->Number() : kUsualSpreadDeg;
  if (degrees < 0 || degrees > 180) {
    throw JsonFault(*spread, Sentence("bumpsDegrees", "is out of range, expected 0 to 180"));
  }
  bumps->spread = degrees * kRadPerDeg;
}

// FNV-1a.
uint64_t SeedOf(const std::string& name) {
  uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

double Uniform(uint64_t bits) { return static_cast<double>(SplitMix64(bits) >> 11) * 0x1p-53; }

double Fraction(double value) { return value - std::floor(value); }

// Evenly over the sphere, and in another order than the wavelengths.
Vector3d AnyDirection(int i, double turn) {
  const double height = 2 * Fraction(i * kGolden) - 1;
  const double angle = 2 * std::numbers::pi * Fraction(i * std::numbers::sqrt2 + turn);
  const double radius = std::sqrt(std::max(0.0, 1 - height * height));
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

// Level, turned from the main direction by an angle of a Gaussian (Box and Muller).
Vector3d WaveDirection(const Bumps& bumps, const Vector3d& zenith, double u, double v) {
  Vector3d level = *bumps.direction - bumps.direction->dot(zenith) * zenith;
  if (level.norm() < 1e-9) level = zenith.unitOrthogonal();
  const double normal = std::sqrt(-2 * std::log(1 - u)) * std::cos(2 * std::numbers::pi * v);
  return Eigen::AngleAxisd(normal * bumps.spread, zenith) * level.normalized();
}

}  // namespace

std::optional<Bumps> ReadBumps(const MaterialKeys& material) {
  const auto node = material.Find("bumps");
  if (!node) return std::nullopt;
  Bumps bumps;
  const JsonNode slope = node->At("rms_slope");
  bumps.rms_slope =
      Positive(slope, Sentence("bumpsSlope", "is out of range, expected a slope above 0"));
  if (bumps.rms_slope > 1) {
    throw JsonFault(slope, Sentence("bumpsSteep", "is out of range, expected at most 1"));
  }
  bumps.longest = Positive(node->At("scale_m"), NoLength());
  bumps.shortest = bumps.longest / std::exp2(kUsualOctaves);
  if (const auto shortest = node->Find("shortest_m")) {
    bumps.shortest = Positive(*shortest, NoLength());
    if (bumps.shortest > bumps.longest) {
      throw JsonFault(*shortest, Sentence("bumpsLonger", "is longer than scale_m"));
    }
  }
  if (const auto spectrum = node->Find("spectrum")) bumps.spectrum = spectrum->Number();
  ReadDirection(*node, &bumps);
  return bumps;
}

Json::Value BumpsJson(const Bumps& bumps) {
  Json::Value json;
  json["rms_slope"] = bumps.rms_slope;
  json["longest"] = bumps.longest;
  json["shortest"] = bumps.shortest;
  json["spectrum"] = bumps.spectrum;
  if (!bumps.direction) return json;
  json["direction"] = ToJson(*bumps.direction);
  json["spread"] = bumps.spread;
  return json;
}

Bumps BumpsOf(const JsonNode& node) {
  Bumps bumps{node.At("rms_slope").Number(), node.At("longest").Number(),
              node.At("shortest").Number(), node.At("spectrum").Number()};
  if (const auto direction = node.Find("direction")) {
    bumps.direction = direction->Vector3();
    bumps.spread = node.At("spread").Number();
  }
  return bumps;
}

BumpField::BumpField(const Bumps& bumps, const std::string& name, const Vector3d& zenith,
                     const Vector3d& origin) {
  const uint64_t seed = SeedOf(name);
  double variance = 0;
  for (int i = 0; i < kWaves; ++i) {
    const auto choice = [&](uint64_t what) {
      return Uniform(seed + 3 * static_cast<uint64_t>(i) + what);
    };
    const double down = (i + choice(0)) / kWaves;  // from the longest, 0..1
    const double length = bumps.longest * std::pow(bumps.shortest / bumps.longest, down);
    const Vector3d along = bumps.direction ? WaveDirection(bumps, zenith, choice(1), choice(2))
                                           : AnyDirection(i, choice(1));
    const double amplitude = std::pow(length / bumps.longest, bumps.spectrum / 2);
    const Vector3d vector = 2 * std::numbers::pi / length * along;
    const double phase = 2 * std::numbers::pi * Uniform(~seed + i) + vector.dot(origin);
    waves_.push_back({vector, amplitude * along, std::fmod(phase, 2 * std::numbers::pi)});
    variance += amplitude * amplitude / 2;
  }
  // A surface sees two of space's three directions, of level waves all.
  const double seen = bumps.direction ? 1 : 2.0 / 3;
  const double factor = bumps.rms_slope / std::sqrt(seen * variance);
  for (Wave& wave : waves_) wave.slope *= factor;
}

BumpField::Turned BumpField::At(const Vector3d& position, const Vector3d& normal,
                                const Eigen::Matrix<double, 3, 2>& spread) const {
  Vector3d gradient = Vector3d::Zero();
  double variance = 0;
  for (const Wave& wave : waves_) {
    const double blur = std::exp(-(spread.transpose() * wave.vector).squaredNorm() / 2);
    const Vector3d along = wave.slope - wave.slope.dot(normal) * normal;
    gradient += blur * std::cos(wave.vector.dot(position) + wave.phase) * along;
    variance += (1 - blur * blur) * along.squaredNorm() / 2;
  }
  return {(normal - gradient).normalized(), variance};
}

}  // namespace insitu
