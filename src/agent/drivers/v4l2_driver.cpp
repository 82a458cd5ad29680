// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/v4l2_driver.hpp"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "files/read_file.hpp"
#include "imageio/decode.hpp"

namespace homeward::agent {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kSilenceLimit = std::chrono::seconds(2);
constexpr auto kStopCheck = std::chrono::milliseconds(100);
constexpr unsigned kBuffers = 4;

driving::Milliseconds now_ms() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now().time_since_epoch()).count();
}

int control(int device, unsigned long request, void* argument) {
  int result = 0;
  do {
    result = ::ioctl(device, request, argument);
  } while (result < 0 && errno == EINTR);
  return result;
}

tl::unexpected<Error> trouble(const std::string& what, const std::string& device) {
  return fail(ErrorCode::kIo, what + ": " + std::strerror(errno) + ".", device);
}

/// An open device with its buffers in memory; everything is given back at the end.
class Capture {
 public:
  explicit Capture(int device) : device_(device) {}
  ~Capture() {
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (streams) control(device_, VIDIOC_STREAMOFF, &type);
    for (const auto& [start, length] : buffers) ::munmap(start, length);
    ::close(device_);
  }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;
  [[nodiscard]] int device() const { return device_; }

  std::vector<std::pair<void*, std::size_t>> buffers;
  V4l2Format format = V4l2Format::kMjpeg;
  std::size_t bytes_per_row = 0;
  bool streams = false;

 private:
  int device_;
};

Result<std::unique_ptr<Capture>> open_device(const std::string& name) {
  const int device = ::open(name.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (device < 0 && (errno == ENOENT || errno == ENODEV || errno == ENXIO)) {
    return fail(ErrorCode::kNotFound, "There is no such camera.", name);
  }
  if (device < 0) return trouble("The camera cannot be opened", name);
  auto capture = std::make_unique<Capture>(device);
  v4l2_capability abilities{};
  if (control(device, VIDIOC_QUERYCAP, &abilities) < 0) return trouble("This is no V4L2 camera", name);
  const unsigned able =
      (abilities.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? abilities.device_caps : abilities.capabilities;
  if ((able & V4L2_CAP_VIDEO_CAPTURE) == 0 || (able & V4L2_CAP_STREAMING) == 0) {
    return fail(ErrorCode::kIo, "This device takes no pictures; many cameras have a second one that does.", name);
  }
  return capture;
}

/// MJPEG at the camera's size, else YUYV: at 640x480 and 30 pictures a second YUYV fills a USB 2 cable.
Status choose_format(Capture& capture, const camera::CameraConfig& camera, const std::string& name) {
  std::string offered;
  for (const auto& [code, format] :
       {std::pair(V4L2_PIX_FMT_MJPEG, V4l2Format::kMjpeg), std::pair(V4L2_PIX_FMT_YUYV, V4l2Format::kYuyv)}) {
    v4l2_format wanted{};
    wanted.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    wanted.fmt.pix.width = static_cast<unsigned>(camera.width_px);
    wanted.fmt.pix.height = static_cast<unsigned>(camera.height_px);
    wanted.fmt.pix.pixelformat = code;
    wanted.fmt.pix.field = V4L2_FIELD_ANY;
    if (control(capture.device(), VIDIOC_S_FMT, &wanted) < 0) {
      if (errno == EBUSY) return trouble("Another program uses the camera", name);
      continue;
    }
    const v4l2_pix_format& given = wanted.fmt.pix;
    if (given.pixelformat != code) continue;
    if (given.width == static_cast<unsigned>(camera.width_px) &&
        given.height == static_cast<unsigned>(camera.height_px)) {
      capture.format = format;
      capture.bytes_per_row = given.bytesperline;
      return {};
    }
    offered = std::to_string(given.width) + " x " + std::to_string(given.height);
  }
  if (offered.empty()) return fail(ErrorCode::kIo, "The camera gives neither MJPEG nor YUYV.", name);
  return fail(ErrorCode::kWrongImageSize,
              "The camera gives no pictures of " + std::to_string(camera.width_px) + " x " +
                  std::to_string(camera.height_px) + " pixels as its camera.json says; the nearest are " + offered +
                  ".",
              name);
}

void ask_rate(const Capture& capture, double pictures_per_s) {
  v4l2_streamparm rate{};
  rate.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  rate.parm.capture.timeperframe = {1000, static_cast<unsigned>(std::lround(1000.0 * pictures_per_s))};
  // A camera that only knows faster rates is slowed by leaving pictures out.
  control(capture.device(), VIDIOC_S_PARM, &rate);
}

v4l2_buffer buffer_at(unsigned index) {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  return buffer;
}

Status start(Capture& capture, const std::string& name) {
  v4l2_requestbuffers request{};
  request.count = kBuffers;
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  if (control(capture.device(), VIDIOC_REQBUFS, &request) < 0) return trouble("The camera gives no buffers", name);
  for (unsigned i = 0; i < request.count; ++i) {
    v4l2_buffer buffer = buffer_at(i);
    if (control(capture.device(), VIDIOC_QUERYBUF, &buffer) < 0) return trouble("A buffer is missing", name);
    void* memory = ::mmap(nullptr, buffer.length, PROT_READ, MAP_SHARED, capture.device(), buffer.m.offset);
    if (memory == MAP_FAILED) return trouble("A buffer cannot be mapped", name);
    capture.buffers.emplace_back(memory, buffer.length);
    if (control(capture.device(), VIDIOC_QBUF, &buffer) < 0) return trouble("A buffer cannot be queued", name);
  }
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (control(capture.device(), VIDIOC_STREAMON, &type) < 0) return trouble("The camera does not start", name);
  capture.streams = true;
  return {};
}

class V4l2Driver final : public driving::Driver {
 public:
  V4l2Driver(std::unique_ptr<Capture> capture, camera::CameraConfig camera, const V4l2DriverConfig& config)
      : capture_(std::move(capture)),
        camera_(std::move(camera)),
        device_(config.device),
        period_ms_(static_cast<driving::Milliseconds>(1000.0 / config.pictures_per_s)) {}

  [[nodiscard]] const camera::CameraConfig& camera() const override { return camera_; }
  [[nodiscard]] driving::Body body() const override { return {}; }
  driving::Reading read() override { return {now_ms(), {}, 0.0, std::nullopt, std::nullopt}; }
  void command(const driving::Motion&) override {}

  Result<std::optional<driving::TakenPicture>> next_picture(std::stop_token stop) override {
    const auto limit = Clock::now() + kSilenceLimit;
    std::optional<Error> damage;
    while (!stop.stop_requested()) {
      if (Clock::now() > limit) {
        if (damage) return tl::unexpected(*damage);
        return fail(ErrorCode::kIo, "The camera has given no picture for two seconds.", device_);
      }
      pollfd wanted{capture_->device(), POLLIN, 0};
      const int ready = ::poll(&wanted, 1, static_cast<int>(kStopCheck.count()));
      if (ready < 0 && errno != EINTR) return trouble("The camera is gone", device_);
      if (ready <= 0) continue;
      if ((wanted.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0) {
        return fail(ErrorCode::kIo, "The camera is gone.", device_);
      }
      auto taken = newest();
      if (!taken) return pass_on(taken);
      if (taken->bytes.empty() || taken->t_ms < taken_ms_ + period_ms_ * 9 / 10) continue;
      auto picture = v4l2_picture(capture_->format, taken->bytes, camera_.width_px, camera_.height_px,
                                  capture_->bytes_per_row, device_);
      if (!picture) {
        // Cameras drop bytes now and then; the next picture is whole.
        damage = picture.error();
        continue;
      }
      picture->t_ms = taken_ms_ = taken->t_ms;
      return std::optional(std::move(*picture));
    }
    return std::optional<driving::TakenPicture>();
  }

 private:
  struct Bytes {
    driving::Milliseconds t_ms = 0;
    std::vector<std::uint8_t> bytes;
  };

  /// The newest of the pictures that wait; the others are given back unseen.
  Result<Bytes> newest() {
    Bytes taken;
    while (true) {
      v4l2_buffer buffer = buffer_at(0);
      if (control(capture_->device(), VIDIOC_DQBUF, &buffer) < 0) {
        if (errno == EAGAIN) return taken;
        return trouble("The camera is gone", device_);
      }
      if (buffer.index >= capture_->buffers.size()) return fail(ErrorCode::kIo, "The camera is confused.", device_);
      const auto& [start, length] = capture_->buffers[buffer.index];
      if ((buffer.flags & V4L2_BUF_FLAG_ERROR) == 0) {
        const auto* first = static_cast<const std::uint8_t*>(start);
        taken.bytes.assign(first, first + std::min<std::size_t>(buffer.bytesused, length));
        taken.t_ms = taken_at(buffer);
      }
      if (control(capture_->device(), VIDIOC_QBUF, &buffer) < 0) return trouble("The camera is gone", device_);
    }
  }

  /// By the kernel's steady clock where the camera's driver stamps with it.
  static driving::Milliseconds taken_at(const v4l2_buffer& buffer) {
    const driving::Milliseconds now = now_ms();
    if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) != V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) return now;
    const driving::Milliseconds stamp =
        1000 * static_cast<driving::Milliseconds>(buffer.timestamp.tv_sec) + buffer.timestamp.tv_usec / 1000;
    constexpr driving::Milliseconds kOldest_ms = 1000;
    return std::clamp(stamp, now - kOldest_ms, now);
  }

  std::unique_ptr<Capture> capture_;
  camera::CameraConfig camera_;
  std::string device_;
  driving::Milliseconds period_ms_;
  driving::Milliseconds taken_ms_ = 0;
};

}  // namespace

Result<driving::TakenPicture> v4l2_picture(V4l2Format format, std::span<const std::uint8_t> bytes, int width_px,
                                           int height_px, std::size_t bytes_per_row, const std::string& device) {
  driving::TakenPicture taken;
  if (format == V4l2Format::kMjpeg) {
    auto picture = imageio::decode(bytes, device);
    if (!picture) return pass_on(picture);
    if (picture->width_px != width_px || picture->height_px != height_px) {
      return fail(ErrorCode::kWrongImageSize, "The camera sent a picture of another size.", device);
    }
    taken.picture = std::move(*picture);
    taken.jpeg.assign(bytes.begin(), bytes.end());
    return taken;
  }
  const std::size_t least_row = 2 * static_cast<std::size_t>(width_px);
  const std::size_t row = std::max(bytes_per_row, least_row);
  const auto rows = static_cast<std::size_t>(height_px);
  if (width_px % 2 != 0 || rows == 0 || bytes.size() < row * (rows - 1) + least_row) {
    return fail(ErrorCode::kTruncatedImage, "The picture ends before its last row.", device);
  }
  // OpenCV only reads from it.
  auto* first = const_cast<std::uint8_t*>(bytes.data());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  const cv::Mat yuyv(height_px, width_px, CV_8UC2, first, row);
  taken.picture = Image(width_px, height_px, 3);
  cv::Mat rgb(height_px, width_px, CV_8UC3, taken.picture.data.data());
  cv::cvtColor(yuyv, rgb, cv::COLOR_YUV2RGB_YUYV);
  return taken;
}

Result<std::unique_ptr<driving::Driver>> make_v4l2_driver(const V4l2DriverConfig& config) {
  if (!(config.pictures_per_s > 0.0 && config.pictures_per_s <= 60.0)) {
    return fail(ErrorCode::kInvalidInput, "The rate must lie between 0 and 60 pictures a second.", "--rate");
  }
  auto camera = files::read_camera(config.camera);
  if (!camera) return pass_on(camera);
  auto capture = open_device(config.device);
  if (!capture) return pass_on(capture);
  if (const Status chosen = choose_format(**capture, *camera, config.device); !chosen) return pass_on(chosen);
  ask_rate(**capture, config.pictures_per_s);
  if (const Status started = start(**capture, config.device); !started) return pass_on(started);
  return std::make_unique<V4l2Driver>(std::move(*capture), std::move(*camera), config);
}

}  // namespace homeward::agent
