// SPDX-License-Identifier: Apache-2.0
#include "server/front/compressed_answers.hpp"

#include <zlib.h>

#include <algorithm>
#include <stdexcept>

namespace homeward::server {
namespace {

constexpr int kLevel = 4;             // of 9: a graph of 5,000 places in a third of the time of 6, and a tenth longer
constexpr int kGzipWindow = 15 + 16;  // zlib's way of asking for gzip's header
constexpr int kMemoryLevel = 8;

bool is_text(const Response& response) {
  const auto type = response.headers.find("content-type");
  if (type == response.headers.end()) return false;
  const std::string_view name = std::string_view(type->second).substr(0, type->second.find(';'));
  return name.starts_with("text/") || name.ends_with("json") || name.ends_with("+xml");
}

}  // namespace

bool accepts_gzip(std::string_view accept_encoding) {
  while (!accept_encoding.empty()) {
    const std::size_t end = std::min(accept_encoding.find(','), accept_encoding.size());
    std::string item(accept_encoding.substr(0, end));
    std::erase_if(item, [](char c) { return c == ' ' || c == '\t'; });
    if (item == "gzip" || item.starts_with("gzip;")) {
      const std::size_t weight = item.find("q=");
      return weight == std::string::npos || item.find_first_of("123456789", weight) != std::string::npos;
    }
    accept_encoding.remove_prefix(std::min(end + 1, accept_encoding.size()));
  }
  return false;
}

std::string gzip(std::string_view text) {
  z_stream stream{};
  if (deflateInit2(&stream, kLevel, Z_DEFLATED, kGzipWindow, kMemoryLevel, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::runtime_error("zlib cannot begin");
  }
  const std::unique_ptr<z_stream, decltype(&deflateEnd)> end(&stream, &deflateEnd);
  std::string bytes(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<unsigned char*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<unsigned char*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  if (deflate(&stream, Z_FINISH) != Z_STREAM_END) throw std::runtime_error("zlib cannot end");
  bytes.resize(stream.total_out);
  return bytes;
}

void CompressedAnswers::compress(const Request& request, Response& response) {
  if (response.body.size() < kLeast_bytes || !is_text(response)) return;
  response.headers["vary"] = "accept-encoding";
  if (!accepts_gzip(request.header("accept-encoding"))) return;
  const auto tag = response.headers.find("etag");
  if (tag == response.headers.end()) {
    response.body = gzip(response.body);
  } else {
    std::string key = request.path + "\n" + tag->second;
    for (const auto& [name, value] : request.query) key += "\n" + name + "=" + value;
    auto bytes = kept(key);
    if (!bytes) {
      bytes = std::make_shared<const std::string>(gzip(response.body));
      keep({key, bytes});
    }
    response.body = *bytes;
    if (!tag->second.starts_with("W/")) tag->second = "W/" + tag->second;
  }
  response.headers["content-encoding"] = "gzip";
}

std::shared_ptr<const std::string> CompressedAnswers::kept(const std::string& key) {
  const std::scoped_lock lock(mutex_);
  const auto found = std::ranges::find(kept_, key, &Kept::key);
  return found == kept_.end() ? nullptr : found->bytes;
}

void CompressedAnswers::keep(Kept answer) {
  const std::scoped_lock lock(mutex_);
  bytes_ += answer.bytes->size();
  kept_.push_back(std::move(answer));
  while (kept_.size() > 1 && bytes_ > kMostKept_bytes) {
    bytes_ -= kept_.front().bytes->size();
    kept_.pop_front();
  }
}

}  // namespace homeward::server
