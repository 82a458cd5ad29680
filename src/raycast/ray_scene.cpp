// SPDX-License-Identifier: Apache-2.0
#include "raycast/ray_scene.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace homeward::raycast {

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

RayScene::RayScene(const Vertices& vertices_m, const Triangles& triangles, std::vector<bool> panes)
    : embree_(std::make_unique<Embree>()), panes_(std::move(panes)) {
  if (triangles.rows() > 0) attach(vertices_m, triangles);
  rtcCommitScene(embree_->scene);
}

void RayScene::attach(const Vertices& vertices_m, const Triangles& triangles) {
  RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto vertex_count = static_cast<std::size_t>(vertices_m.rows());
  const auto triangle_count = static_cast<std::size_t>(triangles.rows());
  void* vertex_buffer =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertex_count);
  void* index_buffer = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                               3 * sizeof(std::uint32_t), triangle_count);
  if (vertex_buffer != nullptr) std::memcpy(vertex_buffer, vertices_m.data(), 3 * sizeof(float) * vertex_count);
  if (index_buffer != nullptr) {
    std::memcpy(index_buffer, triangles.data(), 3 * sizeof(std::uint32_t) * triangle_count);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(embree_->scene, geometry);
  rtcReleaseGeometry(geometry);
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

}  // namespace homeward::raycast
