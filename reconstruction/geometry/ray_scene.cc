// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "calibration/files/error.h"

namespace insitu {
namespace {

void ThrowOnError(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE) {
    throw std::runtime_error("Embree: error " + std::to_string(static_cast<int>(error)));
  }
}

// One device for the process: it owns Embree's threads.
RTCDevice Device() {
  struct Owner {
    RTCDevice device = rtcNewDevice(nullptr);
    Owner() {
      if (device == nullptr) ThrowOnError(nullptr);
    }
    ~Owner() { rtcReleaseDevice(device); }
  };
  static const Owner owner;
  return owner.device;
}

void* NewBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, size_t item_bytes,
                size_t count) {
  void* data = rtcSetNewGeometryBuffer(geometry, type, 0, format, item_bytes, count);
  if (data == nullptr) ThrowOnError(Device());
  return data;
}

constexpr unsigned kTriangles = 0, kSpheres = 1;  // geometries

// Of those that are no facets.
size_t FlatTriangles(const TriangleMesh& mesh) {
  if (mesh.spheres.empty()) return mesh.triangles.size();
  return static_cast<size_t>(mesh.spheres.front().first_facet);
}

void AttachTriangles(RTCScene scene, const TriangleMesh& mesh) {
  const std::unique_ptr<RTCGeometryTy, decltype(&rtcReleaseGeometry)> owner(
      rtcNewGeometry(Device(), RTC_GEOMETRY_TYPE_TRIANGLE), &rtcReleaseGeometry);
  RTCGeometry geometry = owner.get();
  auto* vertices =
      static_cast<float*>(NewBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                                    3 * sizeof(float), mesh.vertices.size()));
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    vertices = std::copy_n(vertex.data(), 3, vertices);
  }
  auto* indices =
      static_cast<unsigned*>(NewBuffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                       3 * sizeof(unsigned), FlatTriangles(mesh)));
  for (size_t t = 0; t < FlatTriangles(mesh); ++t) {
    const Eigen::Vector3i& triangle = mesh.triangles[t];
    INSITU_CHECK(triangle.minCoeff() >= 0 &&
                 triangle.maxCoeff() < static_cast<int>(mesh.vertices.size()));
    indices = std::copy_n(triangle.data(), 3, indices);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, kTriangles);
}

void AttachSpheres(RTCScene scene, const std::vector<MeshSphere>& spheres) {
  const std::unique_ptr<RTCGeometryTy, decltype(&rtcReleaseGeometry)> owner(
      rtcNewGeometry(Device(), RTC_GEOMETRY_TYPE_SPHERE_POINT), &rtcReleaseGeometry);
  RTCGeometry geometry = owner.get();
  if (geometry == nullptr) ThrowOnError(Device());
  auto* values = static_cast<float*>(NewBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4,
                                               4 * sizeof(float), spheres.size()));
  for (const MeshSphere& sphere : spheres) {
    const Eigen::Vector3f center = sphere.center.cast<float>();
    values = std::copy_n(center.data(), 3, values);
    *values++ = static_cast<float>(sphere.radius);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, kSpheres);
}

// Embree's distance is single: of both places where the ray meets the sphere the nearer to it.
RayHit SphereHit(const MeshSphere& sphere, const Eigen::Vector3d& origin,
                 const Eigen::Vector3d& direction, double distance) {
  const Eigen::Vector3d to_center = sphere.center - origin;
  const double along = to_center.dot(direction);
  const double across2 = (to_center - along * direction).squaredNorm();
  const double half = std::sqrt(std::max(0.0, sphere.radius * sphere.radius - across2));
  const double exact = distance < along ? along - half : along + half;
  const Eigen::Vector3d normal = (exact * direction - to_center).normalized();
  const SpherePlace place = FacetTowards(normal, kSphereLevel);
  return {exact, sphere.first_facet + place.facet, place.uv, normal};
}

RTCRay EmbreeRay(const Ray& ray) {
  RTCRay r{};
  r.org_x = static_cast<float>(ray.origin.x());
  r.org_y = static_cast<float>(ray.origin.y());
  r.org_z = static_cast<float>(ray.origin.z());
  r.dir_x = static_cast<float>(ray.direction.x());
  r.dir_y = static_cast<float>(ray.direction.y());
  r.dir_z = static_cast<float>(ray.direction.z());
  r.tnear = static_cast<float>(ray.near);
  r.tfar = static_cast<float>(ray.far);
  r.mask = ~0u;
  return r;
}

}  // namespace

struct RayScene::Embree {
  Embree() : scene(rtcNewScene(Device())) {}
  ~Embree() { rtcReleaseScene(scene); }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  RTCScene scene;
  std::vector<MeshSphere> spheres;

  RayHit HitOf(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double distance,
               unsigned geometry, unsigned primitive, const Eigen::Vector2d& uv) const {
    if (geometry == kSpheres) return SphereHit(spheres[primitive], origin, direction, distance);
    return {distance, static_cast<int>(primitive), uv};
  }
};

RayScene::RayScene(const TriangleMesh& mesh) : embree_(std::make_unique<Embree>()) {
  rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(embree_->scene, RTC_BUILD_QUALITY_MEDIUM);
  embree_->spheres = mesh.spheres;
  if (FlatTriangles(mesh) > 0) AttachTriangles(embree_->scene, mesh);
  if (!mesh.spheres.empty()) AttachSpheres(embree_->scene, mesh.spheres);
  rtcCommitScene(embree_->scene);
  ThrowOnError(Device());
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

std::optional<RayHit> RayScene::Nearest(const Ray& ray) const {
  RTCRayHit query{};
  query.ray = EmbreeRay(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(embree_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return embree_->HitOf(ray.origin, ray.direction, query.ray.tfar, query.hit.geomID,
                        query.hit.primID, {query.hit.u, query.hit.v});
}

bool RayScene::IsOccluded(const Ray& ray) const {
  RTCRay query = EmbreeRay(ray);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(embree_->scene, &context, &query);
  return query.tfar < 0;  // Embree's mark of an occluded ray
}

std::array<std::optional<RayHit>, kPacketSize> RayScene::NearestOfPacket(
    const Eigen::Vector3d& origin, std::span<const Eigen::Vector3d> directions,
    std::span<const double> far) const {
  INSITU_CHECK(directions.size() <= kPacketSize && far.size() == directions.size());
  alignas(64) int valid[kPacketSize] = {};
  RTCRayHit16 query{};
  for (size_t i = 0; i < directions.size(); ++i) {
    valid[i] = -1;
    query.ray.org_x[i] = static_cast<float>(origin.x());
    query.ray.org_y[i] = static_cast<float>(origin.y());
    query.ray.org_z[i] = static_cast<float>(origin.z());
    query.ray.dir_x[i] = static_cast<float>(directions[i].x());
    query.ray.dir_y[i] = static_cast<float>(directions[i].y());
    query.ray.dir_z[i] = static_cast<float>(directions[i].z());
    query.ray.tfar[i] = static_cast<float>(far[i]);
    query.ray.mask[i] = ~0u;
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, embree_->scene, &context, &query);
  std::array<std::optional<RayHit>, kPacketSize> hits;
  for (size_t i = 0; i < directions.size(); ++i) {
    if (query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    hits[i] = embree_->HitOf(origin, directions[i], query.ray.tfar[i], query.hit.geomID[i],
                             query.hit.primID[i], {query.hit.u[i], query.hit.v[i]});
  }
  return hits;
}

uint16_t RayScene::OcclusionMask(const Eigen::Vector3d& origin,
                                 std::span<const Eigen::Vector3f> directions, double near) const {
  constexpr size_t kLanes = 16;
  INSITU_CHECK(directions.size() <= kLanes);
  alignas(64) int valid[kLanes] = {};
  RTCRay16 query{};
  for (size_t i = 0; i < directions.size(); ++i) {
    valid[i] = -1;
    query.org_x[i] = static_cast<float>(origin.x());
    query.org_y[i] = static_cast<float>(origin.y());
    query.org_z[i] = static_cast<float>(origin.z());
    query.dir_x[i] = directions[i].x();
    query.dir_y[i] = directions[i].y();
    query.dir_z[i] = directions[i].z();
    query.tnear[i] = static_cast<float>(near);
    query.tfar[i] = std::numeric_limits<float>::infinity();
    query.mask[i] = ~0u;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded16(valid, embree_->scene, &context, &query);
  uint16_t blocked = 0;
  for (size_t i = 0; i < directions.size(); ++i) {
    if (query.tfar[i] < 0) blocked |= static_cast<uint16_t>(1u << i);
  }
  return blocked;
}

PolygonMesh MeshOfPolygons(const SceneGeometry& scene) {
  PolygonMesh result;
  TriangleMesh& mesh = result.mesh;
  for (size_t p = 0; p < scene.polygons.size(); ++p) {
    const Polygon& polygon = scene.polygons[p];
    const auto triangles = TrianglesOf(polygon);
    INSITU_CHECK(triangles.has_value());  // the adjustment refuses outlines that cross themselves
    const int base = static_cast<int>(mesh.vertices.size());
    for (const Eigen::Vector3d& vertex : AllVertices(polygon)) {
      mesh.vertices.push_back((vertex - scene.origin).cast<float>());
    }
    for (const Eigen::Vector3i& triangle : *triangles) {
      mesh.triangles.push_back(triangle + Eigen::Vector3i::Constant(base));
      result.polygon_of_triangle.push_back(static_cast<int>(p));
    }
  }
  return result;
}

}  // namespace insitu
