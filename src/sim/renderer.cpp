// SPDX-License-Identifier: Apache-2.0
#include "sim/renderer.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <array>
#include <bit>
#include <cmath>
#include <mutex>

#include "sim/hash.hpp"
#include "sim/sensor.hpp"
#include "sim/shading.hpp"

namespace homeward::sim {
namespace {

constexpr float kFar_m = 80.0F;
constexpr std::size_t kBlock = 512;  // pixels that are done at once

/// Directions of the pixels that see something, one array for each coordinate, with room for a whole last packet.
struct Directions {
  std::vector<float> x, y, z;

  void add(const Eigen::Vector3f& direction) {
    x.push_back(direction.x());
    y.push_back(direction.y());
    z.push_back(direction.z());
  }
  void fill_last_packet() {
    while (x.size() % raycast::RayPacket::kMost != 0) add(Eigen::Vector3f::Zero());
  }
  [[nodiscard]] Eigen::Vector3f at(std::size_t i) const { return {x[i], y[i], z[i]}; }

  /// The packet from number `first` on, turned.
  [[nodiscard]] raycast::RayPacket packet(std::size_t first, std::size_t count, const Eigen::Matrix3f& turn) const {
    raycast::RayPacket packet;
    packet.count = count;
    for (std::size_t i = 0; i < raycast::RayPacket::kMost; ++i) {
      const float dx = x[first + i];
      const float dy = y[first + i];
      const float dz = z[first + i];
      packet.x[i] = turn(0, 0) * dx + (turn(0, 1) * dy + turn(0, 2) * dz);
      packet.y[i] = turn(1, 0) * dx + (turn(1, 1) * dy + turn(1, 2) * dz);
      packet.z[i] = turn(2, 0) * dx + (turn(2, 1) * dy + turn(2, 2) * dz);
    }
    return packet;
  }
};

/// An upright cylinder without ends.
struct Cylinder {
  float x_m, y_m, radius_m;
};
Cylinder around(const Person& person) {
  return {static_cast<float>(person.x_m), static_cast<float>(person.y_m), static_cast<float>(kPersonRadius_m)};
}
Cylinder around(const Box& box) {
  constexpr double kMargin_m = 0.01;
  return {static_cast<float>(box.pose.x_m), static_cast<float>(box.pose.y_m),
          static_cast<float>(swept_radius_m(box.foot) + kMargin_m)};
}

/// Whether the line of any ray of a packet meets a cylinder; hit_person() asks the same of its body.
bool meets(const raycast::RayPacket& packet, const Eigen::Vector3f& viewpoint_m, const Cylinder& cylinder) {
  const float ox = viewpoint_m.x() - cylinder.x_m;
  const float oy = viewpoint_m.y() - cylinder.y_m;
  const float c = ox * ox + oy * oy - cylinder.radius_m * cylinder.radius_m;
  int met = 0;
  for (std::size_t i = 0; i < raycast::RayPacket::kMost; ++i) {
    const float a = packet.x[i] * packet.x[i] + packet.y[i] * packet.y[i];
    const float b = ox * packet.x[i] + oy * packet.y[i];
    met |= b * b - a * c > 0.0F ? 1 : 0;
  }
  return met != 0;
}

/// Things in the world that are not of its scene, each in its own light.
template <class Thing>
struct InLight {
  const std::vector<Thing>& things;
  std::vector<Eigen::Array3f> light;
};

/// Where one of these things is nearer than what a ray of the packet has met, writes its colour into `light`, three
/// numbers a ray, and its distance into `hits`. `hit`: where a ray meets one of them.
template <class Thing, class HitThing>
void hide_behind(const InLight<Thing>& lit, const HitThing& hit, const Eigen::Vector3f& viewpoint_m,
                 const raycast::RayPacket& packet, std::array<raycast::Hit, raycast::RayPacket::kMost>& hits,
                 float* light) {
  for (std::size_t thing = 0; thing < lit.things.size(); ++thing) {
    if (!meets(packet, viewpoint_m, around(lit.things[thing]))) continue;
    for (std::size_t i = 0; i < packet.count; ++i) {
      const auto met = hit(lit.things[thing], viewpoint_m, packet.direction(i));
      if (!met || met->distance_m >= hits[i].distance_m) continue;
      hits[i].distance_m = met->distance_m;
      Eigen::Map<Eigen::Array3f>(light + 3 * i) = met->albedo * lit.light[thing];
    }
  }
}

/// What a picture shows of the scene alone, before noise and whoever stands in front of it.
struct Still {
  std::vector<float> light;       // three numbers a pixel
  std::vector<float> distance_m;  // of what each shows

  explicit Still(std::size_t pixels) : light(3 * pixels), distance_m(pixels) {}
};

/// Keeps the still of a robot that stands: from the second picture of one pose on. May be asked by several threads.
class LastStill {
 public:
  struct Answer {
    std::shared_ptr<const Still> known;  // of this pose
    bool worth_keeping = false;          // not known, but the last picture was of this pose too
  };
  Answer at(const Pose2& pose) {
    const Bits bits = std::bit_cast<Bits>(pose);
    const std::lock_guard lock(mutex_);
    if (bits == last_) return {still_, still_ == nullptr};
    last_ = bits;
    still_.reset();
    return {};
  }
  void keep(const Pose2& pose, std::shared_ptr<const Still> still) {
    const std::lock_guard lock(mutex_);
    if (std::bit_cast<Bits>(pose) == last_) still_ = std::move(still);
  }

 private:
  using Bits = std::array<std::uint64_t, 3>;
  std::mutex mutex_;
  std::optional<Bits> last_;
  std::shared_ptr<const Still> still_;
};

}  // namespace

struct Renderer::Parts {
  const raycast::RayScene* rays;
  Shader shader;
  Eigen::Vector3f viewpoint_in_robot_m;
  int width_px;
  int height_px;
  Directions directions_in_robot;
  std::vector<int> pixels;  // that see something: the indices of those directions
  std::unique_ptr<LastStill> last_still = std::make_unique<LastStill>();
  DisplayCurve display{};

  /// What one picture is made of.
  struct Shot {
    Eigen::Matrix3f world_from_robot;
    Eigen::Vector3f viewpoint_m;
    InLight<Person> people;
    InLight<Box> boxes;
    std::uint64_t noise_key;
    const Still* known = nullptr;  // taken before, to be shown again
    Still* kept = nullptr;         // to be filled
  };
  [[nodiscard]] Eigen::Array3f light_at(double x_m, double y_m) const;
  void see(const Shot& shot, std::size_t first, std::size_t end, float* light) const;
  void take(const Shot& shot, std::size_t first, std::size_t end, Image& image) const;
};

// The world keeps its lights, and has to outlive the renderer anyway.
Renderer::Renderer(LitWorld& world, const Light& light, const std::shared_ptr<const camera::Camera>& camera)
    : Renderer(world, light_settings(light, world.world().sky),
               std::shared_ptr<const Irradiance>(std::shared_ptr<void>(), &world.irradiance(light)), camera) {}

Renderer::Renderer(const LitWorld& world, const LightSettings& settings, std::shared_ptr<const Irradiance> light,
                   const std::shared_ptr<const camera::Camera>& camera) {
  const camera::CameraConfig& config = camera->config();
  Directions directions;
  std::vector<int> pixels;
  const camera::BearingTable table = camera::bearing_table(*camera);
  for (std::size_t i = 0; i < table.valid.size(); ++i) {
    if (table.valid[i] == 0) continue;
    pixels.push_back(static_cast<int>(i));
    directions.add(table.bearings.row(static_cast<Eigen::Index>(i)));
  }
  directions.fill_last_packet();
  // The pixels share the solid angle that the camera sees; their mean width decides which texture copy is read.
  double sum_rad = 0.0;
  std::size_t neighbours = 0;
  for (std::size_t i = 1; i < pixels.size(); i += 11) {
    if (pixels[i] != pixels[i - 1] + 1) continue;
    sum_rad += static_cast<double>((directions.at(i) - directions.at(i - 1)).norm());
    ++neighbours;
  }
  const float radians_per_pixel =
      neighbours > 0 ? static_cast<float>(sum_rad / static_cast<double>(neighbours)) : 0.005F;
  parts_ = std::make_unique<Parts>(
      Parts{&world.rays(), Shader(world.fine_scene(), world.surfaces(), std::move(light), settings, radians_per_pixel),
            config.robot_from_camera_translation_m.cast<float>(), config.width_px, config.height_px,
            std::move(directions), std::move(pixels)});
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

/// Light on people and boxes: what falls on the floor at their feet, roughly; it is looked up by a ray straight down.
Eigen::Array3f Renderer::Parts::light_at(double x_m, double y_m) const {
  const Eigen::Vector3f above_m(static_cast<float>(x_m), static_cast<float>(y_m), 1.9F);
  const auto floor = rays->first_hit(above_m, -Eigen::Vector3f::UnitZ(), kFar_m);
  Eigen::Array3f light = Eigen::Array3f::Constant(0.5F);
  if (floor) light = shader.light().corners.row(3 * static_cast<Eigen::Index>(floor->triangle)).array();
  return light * shader.settings().exposure;
}

/// Writes the light of pixels number `first` to `end`, three numbers each, and one more that means nothing.
void Renderer::Parts::see(const Shot& shot, std::size_t first, std::size_t end, float* light) const {
  const LightSettings& settings = shader.settings();
  const auto beyond = [&](const Eigen::Vector3f& direction) -> Eigen::Array4f {
    Eigen::Array4f seen = Eigen::Array4f::Constant(0.6F * settings.window_shown);
    if (settings.sky) seen.head<3>() = radiance(*settings.sky, direction) * settings.exposure;
    return seen;
  };
  for (std::size_t i = first; i < end; i += raycast::RayPacket::kMost) {
    const raycast::RayPacket packet =
        directions_in_robot.packet(i, std::min(raycast::RayPacket::kMost, end - i), shot.world_from_robot);
    float* packet_light = light + 3 * (i - first);
    std::array<raycast::Hit, raycast::RayPacket::kMost> hits;
    if (shot.known != nullptr) {
      std::copy_n(shot.known->light.data() + 3 * i, 3 * packet.count, packet_light);
      for (std::size_t k = 0; k < packet.count; ++k) hits[k].distance_m = shot.known->distance_m[i + k];
    } else {
      hits = rays->first_hits(shot.viewpoint_m, packet, kFar_m);
      for (std::size_t k = 0; k < packet.count; ++k) {
        Eigen::Map<Eigen::Array4f>(packet_light + 3 * k) = hits[k].triangle == raycast::Hit::kNoTriangle
                                                               ? beyond(packet.direction(k))
                                                               : shader.shade(hits[k], packet.direction(k));
      }
    }
    if (shot.kept != nullptr) {
      std::copy_n(packet_light, 3 * packet.count, shot.kept->light.data() + 3 * i);
      for (std::size_t k = 0; k < packet.count; ++k) shot.kept->distance_m[i + k] = hits[k].distance_m;
    }
    hide_behind(shot.people, hit_person, shot.viewpoint_m, packet, hits, packet_light);
    hide_behind(shot.boxes, hit_box, shot.viewpoint_m, packet, hits, packet_light);
  }
}

/// Pixels number `first` to `end` of those that see something, at most kBlock of them.
void Renderer::Parts::take(const Shot& shot, std::size_t first, std::size_t end, Image& image) const {
  std::array<float, 3 * kBlock + 1> light;
  see(shot, first, end, light.data());
  for (std::size_t run = first; run < end;) {  // of neighbours in the picture
    std::size_t past = run + 1;
    while (past < end && pixels[past] == pixels[past - 1] + 1) ++past;
    const std::size_t begin = 3 * static_cast<std::size_t>(pixels[run]);
    expose(display, light.data() + 3 * (run - first), 3 * (past - run), shot.noise_key + begin,
           shader.settings().noise_levels, image.data.data() + begin);
    run = past;
  }
}

Image Renderer::render(const Pose2& robot, const std::vector<Person>& people, std::uint64_t noise_seed,
                       const std::vector<Box>& boxes) const {
  const Parts& parts = *parts_;
  Image image(parts.width_px, parts.height_px, 3);
  const Eigen::Matrix3f world_from_robot =
      Eigen::AngleAxisf(static_cast<float>(robot.theta_rad), Eigen::Vector3f::UnitZ()).toRotationMatrix();
  const Eigen::Vector3f viewpoint_m =
      world_from_robot * parts.viewpoint_in_robot_m +
      Eigen::Vector3f(static_cast<float>(robot.x_m), static_cast<float>(robot.y_m), 0.0F);
  Parts::Shot shot{world_from_robot, viewpoint_m, {people, {}}, {boxes, {}}, mix(noise_seed)};
  for (const Person& person : people) shot.people.light.push_back(parts.light_at(person.x_m, person.y_m));
  for (const Box& box : boxes) shot.boxes.light.push_back(parts.light_at(box.pose.x_m, box.pose.y_m));
  const LastStill::Answer still = parts.last_still->at(robot);
  const auto kept = still.worth_keeping ? std::make_shared<Still>(parts.pixels.size()) : nullptr;
  shot.known = still.known.get();
  shot.kept = kept.get();
  const std::size_t blocks = (parts.pixels.size() + kBlock - 1) / kBlock;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks, 1), [&](const auto& range) {
    for (std::size_t block = range.begin(); block != range.end(); ++block) {
      parts.take(shot, kBlock * block, std::min(parts.pixels.size(), kBlock * (block + 1)), image);
    }
  });
  if (kept) parts.last_still->keep(robot, kept);
  return image;
}

}  // namespace homeward::sim
