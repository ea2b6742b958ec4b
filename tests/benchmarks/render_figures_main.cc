// SPDX-License-Identifier: GPL-3.0-or-later
// render_figures SITE [PHOTO...]: what rendering a site costs, stage by stage, as JSON; and the
// rate of rays that Embree alone reaches on the same site in the same run.
#include <embree3/rtcore.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>

#include "calibration/files/json_file.h"
#include "calibration/photo/photograph.h"
#include "radiometry/transport/cosine_directions.h"
#include "renderer/render_site.h"
#include "renderer/trace/interreflected_light.h"
#include "renderer/trace/make_montage_scene.h"

namespace insitu {
namespace {

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

rusage Usage() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage;
}

// Wall and CPU time since it was made, and the most memory that the process has had.
class Meter {
 public:
  Json::Value Json(double rays = 0) const {
    const rusage now = Usage();
    const double cpu = Seconds(now.ru_utime) + Seconds(now.ru_stime) - Seconds(start_.ru_utime) -
                       Seconds(start_.ru_stime);
    Json::Value json;
    json["seconds"] =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
    json["cpu_seconds"] = cpu;
    json["peak_memory_mb"] = static_cast<double>(now.ru_maxrss) / 1024;
    if (rays <= 0) return json;
    json["rays"] = rays;
    json["rays_per_cpu_second"] = rays / std::max(cpu, 1e-9);
    return json;
  }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  rusage start_ = Usage();
};

// The site's triangles in an Embree scene of the same settings as RayScene's.
class BareEmbree {
 public:
  explicit BareEmbree(const TriangleMesh& mesh) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.vertices.size()));
    for (const Eigen::Vector3f& vertex : mesh.vertices) {
      vertices = std::copy_n(vertex.data(), 3, vertices);
    }
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), mesh.triangles.size()));
    for (const Eigen::Vector3i& triangle : mesh.triangles) {
      indices = std::copy_n(triangle.data(), 3, indices);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~BareEmbree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  BareEmbree(const BareEmbree&) = delete;
  BareEmbree& operator=(const BareEmbree&) = delete;

  // How many of a packet's rays hit.
  int Hits(RTCRayHit16 query) const {
    alignas(64) int valid[16];
    std::fill(std::begin(valid), std::end(valid), -1);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid, scene_, &context, &query);
    return static_cast<int>(
        std::count_if(std::begin(query.hit.geomID), std::end(query.hit.geomID),
                      [](unsigned id) { return id != RTC_INVALID_GEOMETRY_ID; }));
  }

 private:
  RTCDevice device_ = rtcNewDevice(nullptr);
  RTCScene scene_ = rtcNewScene(device_);
};

RTCRayHit16 PacketOf(const Eigen::Vector3d& origin, std::span<const Eigen::Vector3d> directions) {
  RTCRayHit16 query{};
  for (size_t i = 0; i < directions.size(); ++i) {
    query.ray.org_x[i] = static_cast<float>(origin.x());
    query.ray.org_y[i] = static_cast<float>(origin.y());
    query.ray.org_z[i] = static_cast<float>(origin.z());
    query.ray.dir_x[i] = static_cast<float>(directions[i].x());
    query.ray.dir_y[i] = static_cast<float>(directions[i].y());
    query.ray.dir_z[i] = static_cast<float>(directions[i].z());
    query.ray.tfar[i] = std::numeric_limits<float>::infinity();
    query.ray.mask[i] = ~0u;
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  return query;
}

// Points a hand's breadth above the middles of a mesh's triangles.
std::vector<SurfacePoint> PointsOn(const TriangleMesh& mesh, size_t most) {
  std::vector<SurfacePoint> points;
  const size_t step = mesh.triangles.size() / most + 1;
  for (size_t t = 0; t < mesh.triangles.size(); t += step) {
    Eigen::Matrix3d corners;
    for (int i = 0; i < 3; ++i) {
      corners.col(i) = mesh.vertices[mesh.triangles[t][i]].cast<double>();
    }
    const Eigen::Vector3d normal =
        (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).normalized();
    points.push_back({corners.rowwise().mean() + 0.1 * normal, normal});
  }
  return points;
}

// Packets of directions as light is gathered with, by RayScene and by Embree alone, on one core.
Json::Value RateOverEmbree(const MontageScene& scene) {
  constexpr int kDirections = 512, kRounds = 40;
  const CosineDirections directions(kDirections);
  const BareEmbree embree(scene.natural_mesh);
  std::array<double, kPacketSize> far;
  far.fill(std::numeric_limits<double>::infinity());
  std::vector<RTCRayHit16> packets;
  std::vector<std::pair<Eigen::Vector3d, std::vector<Eigen::Vector3d>>> ours;
  for (const SurfacePoint& point : PointsOn(scene.natural_mesh, 200)) {
    const std::vector<Eigen::Vector3d> all = directions.About(point.normal);
    for (int first = 0; first < kDirections; first += kPacketSize) {
      const std::span packet(&all[first], kPacketSize);
      packets.push_back(PacketOf(point.position, packet));
      ours.emplace_back(point.position, std::vector<Eigen::Vector3d>(packet.begin(), packet.end()));
    }
  }
  const double rays =
      static_cast<double>(kRounds) * kPacketSize * static_cast<double>(packets.size());
  long hits = 0, our_hits = 0;
  const Meter bare;
  for (int round = 0; round < kRounds; ++round) {
    for (const RTCRayHit16& packet : packets) hits += embree.Hits(packet);
  }
  Json::Value json;
  json["embree"] = bare.Json(rays);
  const Meter wrapped;
  for (int round = 0; round < kRounds; ++round) {
    for (const auto& [origin, packet] : ours) {
      const auto met = scene.natural_rays.NearestOfPacket(origin, packet, far);
      our_hits += std::ranges::count_if(met, [](const auto& hit) { return hit.has_value(); });
    }
  }
  json["ours"] = wrapped.Json(rays);
  json["same_hits"] = hits == our_hits;
  json["over_embree"] = json["ours"]["rays_per_cpu_second"].asDouble() /
                        json["embree"]["rays_per_cpu_second"].asDouble();
  return json;
}

MontageScene Load(const SitePaths& site) {
  NaturalEnvironment natural = ReadEnvironment(site);
  std::vector<Raster> images;
  for (const InputImage& image : natural.input_images) {
    images.push_back(ReadPhotograph(image.file).linear);
  }
  return MakeMontageScene(std::move(natural), ReadArtificialEnvironment(site), std::move(images));
}

double GatheredRays(const InterreflectedLight& light) {
  const InterreflectionOptions options;
  return static_cast<double>(light.on_site.points() + light.on_building.points()) *
         options.point_directions;
}

int Run(const SitePaths& site, const std::vector<std::string>& photos) {
  Json::Value json;
  const Meter loading;
  MontageScene scene = Load(site);
  json["stages"]["load"] = loading.Json();
  json["packets"] = RateOverEmbree(scene);
  const Meter solving;
  AddInterreflection(&scene, std::nullopt);
  const InterreflectedLight& light = *scene.interreflected;
  const double patch_rays = static_cast<double>(light.interreflection.patches()) *
                            InterreflectionOptions().patch_directions;
  json["stages"]["solve"] = solving.Json(patch_rays);
  for (size_t i = 0; i < scene.natural.scene.cameras.size(); ++i) {
    const PosedCamera& camera = scene.natural.scene.cameras[i];
    if (!photos.empty() && std::ranges::find(photos, camera.photo) == photos.end()) continue;
    RenderOptions options;
    options.point_spread = scene.natural.qualities[i].point_spread;
    PosedCamera pinhole = camera;  // the input image's frame: no photograph need be there
    pinhole.camera = scene.natural.input_images[i].camera;
    const double gathered = GatheredRays(light);
    const Meter rendering;
    const RenderResult result = RenderMontage(scene, pinhole, scene.input_images[i], options);
    const double pixels = static_cast<double>(pinhole.camera.width()) * pinhole.camera.height();
    const double camera_rays = result.mean_rays * pixels;
    Json::Value one = rendering.Json(camera_rays + GatheredRays(light) - gathered);
    one["photo"] = camera.photo;
    one["pixels"] = pixels;
    one["camera_rays"] = camera_rays;
    json["stages"]["photos"].append(one);
  }
  std::cout << json.toStyledString();
  return 0;
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "render_figures SITE [PHOTO...]\n");
    return 2;
  }
  try {
    return insitu::Run({argv[1]}, {argv + 2, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "render_figures: %s\n", error.what());
    return 1;
  }
}
