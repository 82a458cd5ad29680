// SPDX-License-Identifier: Apache-2.0
#include "sim/ray_scene.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "sim/triangles.hpp"

namespace homeward::sim {

struct RayScene::Embree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Embree() : device(rtcNewDevice("threads=0")) {
    if (device == nullptr) throw std::runtime_error("Embree found no usable processor.");
    scene = rtcNewScene(device);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  ~Embree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
};

RayScene::RayScene(const Scene& scene) : embree_(std::make_unique<Embree>()) {
  RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto vertices = static_cast<std::size_t>(scene.vertices_m.rows());
  const auto triangles = static_cast<std::size_t>(scene.triangles.rows());
  void* vertex_buffer =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices);
  void* index_buffer = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                               3 * sizeof(std::uint32_t), triangles);
  if (vertex_buffer != nullptr) std::memcpy(vertex_buffer, scene.vertices_m.data(), 3 * sizeof(float) * vertices);
  if (index_buffer != nullptr) {
    std::memcpy(index_buffer, scene.triangles.data(), 3 * sizeof(std::uint32_t) * triangles);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(embree_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(embree_->scene);
  panes_.reserve(scene.triangle_materials.size());
  for (const int material : scene.triangle_materials) {
    panes_.push_back(scene.materials[static_cast<std::size_t>(material)].role == MaterialRole::kWindow);
  }
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

std::optional<Hit> RayScene::first_hit(const Eigen::Vector3f& origin_m, const Eigen::Vector3f& direction,
                                       float far_m) const {
  RTCRayHit ray{};
  ray.ray.org_x = origin_m.x();
  ray.ray.org_y = origin_m.y();
  ray.ray.org_z = origin_m.z();
  ray.ray.dir_x = direction.x();
  ray.ray.dir_y = direction.y();
  ray.ray.dir_z = direction.z();
  ray.ray.tnear = 0.0F;
  ray.ray.tfar = far_m;
  ray.ray.mask = 0xFFFFFFFFU;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(embree_->scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Hit{ray.hit.primID, ray.hit.u, ray.hit.v, ray.ray.tfar};
}

std::array<Hit, RayPacket::kMost> RayScene::first_hits(const Eigen::Vector3f& origin_m, const RayPacket& packet,
                                                       float far_m) const {
  constexpr std::size_t kRays = RayPacket::kMost;
  alignas(32) std::array<int, kRays> valid;
  alignas(32) RTCRayHit8 rays;  // what is not set here is not read
  for (std::size_t i = 0; i < kRays; ++i) valid[i] = i < packet.count ? -1 : 0;
  std::copy_n(packet.x.begin(), kRays, rays.ray.dir_x);
  std::copy_n(packet.y.begin(), kRays, rays.ray.dir_y);
  std::copy_n(packet.z.begin(), kRays, rays.ray.dir_z);
  std::fill_n(rays.ray.org_x, kRays, origin_m.x());
  std::fill_n(rays.ray.org_y, kRays, origin_m.y());
  std::fill_n(rays.ray.org_z, kRays, origin_m.z());
  std::fill_n(rays.ray.tnear, kRays, 0.0F);
  std::fill_n(rays.ray.tfar, kRays, far_m);
  std::fill_n(rays.ray.time, kRays, 0.0F);
  std::fill_n(rays.ray.mask, kRays, 0xFFFFFFFFU);
  std::fill_n(rays.ray.flags, kRays, 0U);
  std::fill_n(rays.hit.u, kRays, 0.0F);
  std::fill_n(rays.hit.v, kRays, 0.0F);
  std::fill_n(rays.hit.geomID, kRays, RTC_INVALID_GEOMETRY_ID);
  std::fill_n(rays.hit.primID, kRays, Hit::kNoTriangle);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid.data(), embree_->scene, &context, &rays);
  std::array<Hit, kRays> hits;
  for (std::size_t i = 0; i < kRays; ++i) {
    hits[i] = Hit{rays.hit.primID[i], rays.hit.u[i], rays.hit.v[i], rays.ray.tfar[i]};
  }
  return hits;
}

bool RayScene::blocked(const Eigen::Vector3f& from_m, const Eigen::Vector3f& to_m) const {
  const Eigen::Vector3f way_m = to_m - from_m;
  RTCRay ray{};
  ray.org_x = from_m.x();
  ray.org_y = from_m.y();
  ray.org_z = from_m.z();
  ray.dir_x = way_m.x();
  ray.dir_y = way_m.y();
  ray.dir_z = way_m.z();
  ray.tnear = 0.0F;
  ray.tfar = 1.0F;
  ray.mask = 0xFFFFFFFFU;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(embree_->scene, &context, &ray);
  return ray.tfar < 0.0F;
}

namespace {

void split(const std::array<Corner, 3>& corners, int material, float max_edge2, int depth, LooseTriangles& triangles) {
  std::size_t longest = 0;
  float longest2 = 0.0F;
  for (std::size_t i = 0; i < 3; ++i) {
    const float edge2 = (corners[(i + 1) % 3].position_m - corners[i].position_m).squaredNorm();
    if (edge2 > longest2) {
      longest2 = edge2;
      longest = i;
    }
  }
  if (longest2 <= max_edge2 || depth == 0) {
    triangles.add(corners, material);
    return;
  }
  const Corner& a = corners[longest];
  const Corner& b = corners[(longest + 1) % 3];
  const Corner& c = corners[(longest + 2) % 3];
  const Corner middle{0.5F * (a.position_m + b.position_m), 0.5F * (a.uv + b.uv)};
  split({a, middle, c}, material, max_edge2, depth - 1, triangles);
  split({middle, b, c}, material, max_edge2, depth - 1, triangles);
}

}  // namespace

Scene tessellate(const Scene& scene, float max_edge_m) {
  constexpr int kMaxDepth = 16;
  LooseTriangles triangles;
  for (Eigen::Index t = 0; t < scene.triangles.rows(); ++t) {
    std::array<Corner, 3> corners;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::Index vertex = scene.triangles(t, k);
      corners[static_cast<std::size_t>(k)] = {scene.vertices_m.row(vertex), scene.texture_uv.row(vertex)};
    }
    split(corners, scene.triangle_materials[static_cast<std::size_t>(t)], max_edge_m * max_edge_m, kMaxDepth,
          triangles);
  }
  Scene fine = triangles.take();
  fine.materials = scene.materials;
  fine.textures = scene.textures;
  return fine;
}

}  // namespace homeward::sim
