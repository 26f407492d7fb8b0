// SPDX-License-Identifier: Apache-2.0
#include "lightwell/client/client.h"

#include <algorithm>
#include <cmath>

#include "lightwell/asset/codecs.h"
#include "lightwell/asset/light_asset.h"
#include "lightwell/client/download.h"
#include "lightwell/client/requests.h"
#include "lightwell/light/lattice_links.h"
#include "lightwell/pack/self_contained.h"

namespace lightwell {

class Client::Machine {
 public:
  explicit Machine(const ClientOptions& options)
      : requests_(download_, options.strategy, options.seed), context_{.bin = {}, .fill = options.fill} {}

  std::optional<Action> next(double now) { return requests_.next(weights_, now); }

  Requests& requests() { return requests_; }

  /// Follows up on what the requests have received: checks the opening once it is complete, and takes over their
  /// failure.
  void follow() {
    if (failure_) return;
    if (requests_.failure()) return give_up(*requests_.failure());
    if (weights_.empty() && download_.opened()) weights_.assign(download_.directory().streams.size(), 1.0f);
    if (!checked_ && download_.opened()) check_opening();
  }

  bool work() {
    if (failure_ || !download_.opened() || opening_waits()) return false;
    if (decoders_.size() < download_.directory().streams.size()) {
      open_decoder();
      return !failure_;
    }
    return decode_next() || settle_next();
  }

  std::optional<Update> take(size_t budget) {
    if (failure_) return take_failure();
    if (!download_.opened() || opening_waits()) return std::nullopt;
    if (!opening_taken_) {
      opening_taken_ = true;
      return OpeningUpdate{download_.opening()};
    }
    // All announcements come first, since a caller may stop taking pieces when it runs out of room.
    while (announced_ < decoders_.size())
      if (std::optional<Update> update = decoders_[announced_++]->announce()) return update;
    if (decoders_.size() < download_.directory().streams.size()) return std::nullopt;
    const size_t count = decoders_.size();
    for (size_t tried = 0; tried < count; tried++) {
      if (std::optional<Update> update = decoders_[turn_]->take(budget)) return update;
      turn_ = (turn_ + 1) % count;
    }
    if (completed_ || !all_decoded()) return std::nullopt;
    for (size_t i = 0; i < count; i++)
      if (!decoders_[i]->complete()) {
        give_up(FailureUpdate::unreadable({"", "stream " + std::to_string(i), "is not complete"}));
        return take_failure();
      }
    completed_ = true;
    requests_.stop();  // a later change of the file does not matter any more
    return CompleteUpdate{};
  }

  void set_weight(uint32_t asset, float weight) {
    if (!(weight >= 0 && std::isfinite(weight))) return;
    for (uint32_t stream = 0; stream < weights_.size(); stream++)
      if (asset_of_stream(stream) == asset) weights_[stream] = weight;
  }

  std::vector<Vec3f> blocked_links(uint32_t asset) const {
    for (uint32_t stream = 0; stream < decoders_.size(); stream++)
      if (asset_of_stream(stream) == asset && download_.directory().streams[stream].kind == StreamKind::light)
        return lightwell::blocked_links(static_cast<const LightAsset&>(*decoders_[stream]).filled(Fill::none));
    return {};
  }

  ClientProgress progress() const {
    ClientProgress progress;
    progress.bytes_total = download_.file_length();
    progress.requests = requests_.sent();
    progress.failures = requests_.failures();
    if (!download_.opened()) return progress;
    const std::vector<StreamEntry>& streams = download_.directory().streams;
    progress.bytes = progress.bytes_total;
    for (size_t i = 0; i < streams.size(); i++) {
      const bool light = is_light(streams[i].kind);
      (light ? progress.light_bytes : progress.geometry_bytes) += download_.received(i);
      (light ? progress.light_bytes_total : progress.geometry_bytes_total) += streams[i].length;
      progress.bytes -= streams[i].length - download_.received(i);
      if (i >= decoders_.size()) continue;
      (light ? progress.nodes : progress.faces) += decoders_[i]->decoded();
      (light ? progress.nodes_total : progress.faces_total) += decoders_[i]->total();
    }
    return progress;
  }

  bool ended() const { return completed_ || failure_taken_; }

 private:
  void check_opening() {
    checked_ = true;
    const Bytes json = glb_chunks(download_.opening()).json;
    const auto contained = check_self_contained({reinterpret_cast<const char*>(json.data()), json.size()});
    if (!contained) give_up(FailureUpdate::unreadable(contained.error()));
  }

  /// True while the response that delivered the opening is still delivering the first block of a light stream, if that
  /// is close behind. The first picture is to be lit, and the eight corners that are known without a block may lie in
  /// the dark.
  bool opening_waits() const {
    if (opening_taken_) return false;
    constexpr uint64_t not_far = 16384;
    const std::vector<StreamEntry>& streams = download_.directory().streams;
    for (size_t i = 0; i < streams.size(); i++) {
      if (streams[i].kind != StreamKind::light || streams[i].blocks == 0 || download_.ready(i)) continue;
      const uint64_t end = download_.table(i).extent(0).end();
      if (end <= download_.table(0).begin() + not_far && requests_.opening_brings(end)) return true;
    }
    return false;
  }

  /// Opens the next stream's decoder. A light stream also decodes its first block, so that it can be taken at once,
  /// however much waits to be decoded.
  void open_decoder() {
    const uint32_t stream = static_cast<uint32_t>(decoders_.size());
    context_.bin = glb_chunks(download_.opening()).bin;
    auto decoder = open_asset(download_.directory(), stream, context_);
    if (!decoder) return give_up(FailureUpdate::unreadable(decoder.error()));
    decoders_.push_back(std::move(*decoder));
    if (download_.directory().streams[stream].kind == StreamKind::light && download_.ready(stream)) decode(stream);
    if (!failure_) decoders_.back()->settle();
  }

  /// Decodes a block of the next stream, taking turns, that has one ready and accepts it.
  bool decode_next() {
    const size_t count = decoders_.size();
    for (size_t tried = 0; tried < count; tried++) {
      const size_t stream = decoding_;
      decoding_ = (decoding_ + 1) % count;
      if (!download_.ready(stream) || !decoders_[stream]->accepts()) continue;
      decode(stream);
      return !failure_;
    }
    return false;
  }

  /// Decodes the next block of a stream, which must be ready.
  void decode(size_t stream) {
    const auto decoded = decoders_[stream]->append(download_.take(stream));
    if (decoded) return;
    const std::string block = std::to_string(download_.taken(stream) - 1);
    give_up(FailureUpdate::unreadable(
        in_element(decoded.error(), "stream " + std::to_string(stream) + ", block " + block)));
  }

  bool settle_next() {
    return std::ranges::any_of(decoders_, [](const auto& decoder) { return decoder->settle(); });
  }

  /// True when every block has been decoded and prepared for take().
  bool all_decoded() const {
    for (size_t i = 0; i < download_.directory().streams.size(); i++)
      if (!download_.complete(i)) return false;
    return decoders_.size() == download_.directory().streams.size() &&
           std::ranges::all_of(decoders_, [](const auto& decoder) { return decoder->settled(); });
  }

  void give_up(FailureUpdate failure) {
    failure_ = std::move(failure);
    requests_.stop();
  }

  std::optional<Update> take_failure() {
    if (failure_taken_) return std::nullopt;
    failure_taken_ = true;
    return *failure_;
  }

  Download download_;
  Requests requests_;
  std::vector<float> weights_;
  AssetContext context_;
  std::vector<std::unique_ptr<AssetDecoder>> decoders_;  ///< of the first streams, as far as they are open
  size_t decoding_ = 0;                                  ///< the stream whose turn it is to be decoded
  size_t announced_ = 0;                                 ///< number of decoders whose announcement was taken
  size_t turn_ = 0;                                      ///< the stream whose turn it is in take()
  bool checked_ = false;
  bool opening_taken_ = false;
  bool completed_ = false;
  bool failure_taken_ = false;
  std::optional<FailureUpdate> failure_;
};

Client::Client(const ClientOptions& options) : machine_(std::make_unique<Machine>(options)) {}
Client::Client(Client&&) noexcept = default;
Client& Client::operator=(Client&&) noexcept = default;
Client::~Client() = default;

std::optional<Action> Client::next(double now) { return machine_->next(now); }

void Client::respond(uint32_t id, const ResponseHead& head, double now) {
  machine_->requests().respond(id, head, now);
  machine_->follow();
}

void Client::receive(uint32_t id, Bytes bytes, double now) {
  machine_->requests().receive(id, bytes, now);
  machine_->follow();
}

void Client::finish(uint32_t id, double now) {
  machine_->requests().finish(id, now);
  machine_->follow();
}

void Client::fail(uint32_t id, double now) { machine_->requests().fail(id, now); }

bool Client::work() { return machine_->work(); }

std::optional<Update> Client::take(size_t budget) { return machine_->take(budget); }

double Client::wake() const { return machine_->requests().wake(); }

void Client::set_weight(uint32_t asset, float weight) { machine_->set_weight(asset, weight); }

std::vector<Vec3f> Client::blocked_links(uint32_t asset) const { return machine_->blocked_links(asset); }
void Client::set_strategy(Strategy strategy) { machine_->requests().set_strategy(strategy); }

ClientProgress Client::progress() const { return machine_->progress(); }

bool Client::ended() const { return machine_->ended(); }

}  // namespace lightwell
