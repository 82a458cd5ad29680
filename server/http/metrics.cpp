// SPDX-License-Identifier: Apache-2.0
#include "server/http/metrics.hpp"

#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

#include <mutex>
#include <vector>

namespace homeward::server {

struct Metrics::State {
  prometheus::Registry registry;
  prometheus::Family<prometheus::Counter>& requests =
      prometheus::BuildCounter().Name("homeward_http_requests_total").Help("Answered HTTP requests").Register(registry);
  prometheus::Family<prometheus::Histogram>& durations = prometheus::BuildHistogram()
                                                             .Name("homeward_http_request_duration_seconds")
                                                             .Help("From the whole request to its answer")
                                                             .Register(registry);
  struct Read {
    prometheus::Gauge* gauge;
    std::function<double()> read;
  };
  std::mutex mutex;
  std::vector<Read> gauges;
};

Metrics::Metrics() : state_(std::make_unique<State>()) {}
Metrics::~Metrics() = default;

void Metrics::answered(const std::string& method, const std::string& route, int status, double seconds) {
  state_->requests.Add({{"method", method}, {"route", route}, {"status", std::to_string(status)}}).Increment();
  static const prometheus::Histogram::BucketBoundaries kBuckets{0.001, 0.005, 0.02, 0.1, 0.5, 2.0, 10.0};
  state_->durations.Add({{"route", route}}, kBuckets).Observe(seconds);
}

void Metrics::gauge(const std::string& name, const std::string& help, std::function<double()> read) {
  prometheus::Gauge& gauge = prometheus::BuildGauge().Name(name).Help(help).Register(state_->registry).Add({});
  const std::scoped_lock lock(state_->mutex);
  state_->gauges.push_back({&gauge, std::move(read)});
}

std::string Metrics::text() {
  const std::scoped_lock lock(state_->mutex);
  for (const State::Read& one : state_->gauges) one.gauge->Set(one.read());
  return prometheus::TextSerializer().Serialize(state_->registry.Collect());
}

}  // namespace homeward::server
