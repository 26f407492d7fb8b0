// SPDX-License-Identifier: Apache-2.0
//
// What a client hands over first: an opening, and with it the light that the same answer brings.
#include <gtest/gtest.h>

#include "lightwell/client/client.h"
#include "lightwell/pack/opening.h"
#include "tests/client/sample_pack.h"

namespace lightwell {
namespace {

/// The first request of a client, answered piece by piece.
class FirstAnswer {
 public:
  explicit FirstAnswer(Bytes file) : file_(file), client_({}), id_(client_.next(0)->id) {
    client_.respond(id_, {.status = 206, .content_range = {}, .etag = {}}, 0);
  }

  /// Brings what is still missing up to `end`, in pieces of `piece` bytes, until the opening was handed over.
  void bring(size_t end, size_t piece) {
    while (!opened_ && at_ < end) {
      const size_t length = std::min(piece, end - at_);
      client_.receive(id_, file_.subspan(at_, length), 0);
      at_ += length;
      take_all();
    }
  }
  void finish() {
    client_.finish(id_, 0);
    client_.next(0);  // asks for the rest, for which the opening does not wait
    take_all();
  }

  bool opened() const { return opened_; }
  uint32_t first_nodes() const { return first_nodes_; }

 private:
  void take_all() {
    do {
      while (const std::optional<Update> update = client_.take(1 << 20)) {
        opened_ = opened_ || std::holds_alternative<OpeningUpdate>(*update);
        if (const auto* light = std::get_if<LightUpdate>(&*update); light && first_nodes_ == 0)
          first_nodes_ = light->nodes;
      }
    } while (client_.work());
  }

  Bytes file_;
  Client client_;
  uint32_t id_;
  size_t at_ = 0;
  bool opened_ = false;
  uint32_t first_nodes_ = 0;
};

struct Sample {
  std::vector<uint8_t> file = sample_pack(sample_scene(2000, 12));
  size_t head = static_cast<size_t>(measure_opening(file)->needed);  ///< opening and directory
};

TEST(FirstPicture, ComesWithTheFirstBlockOfLightHoweverTheBytesAreCut) {
  const Sample sample;
  for (const size_t piece : {1, 7, 500, 1500, 20000, 65536}) {
    SCOPED_TRACE(piece);
    FirstAnswer answer(sample.file);
    answer.bring(sample.head, piece);
    EXPECT_FALSE(answer.opened());
    answer.bring(65536, piece);
    EXPECT_TRUE(answer.opened());
    EXPECT_GT(answer.first_nodes(), 8u);
  }
}

TEST(FirstPicture, DoesNotWaitForWhatIsNotOnItsWay) {
  const Sample sample;
  for (const size_t more : {0, 1, 30}) {
    FirstAnswer answer(sample.file);
    answer.bring(sample.head + more, 1000);
    EXPECT_FALSE(answer.opened());
    answer.finish();
    EXPECT_TRUE(answer.opened());
    EXPECT_EQ(answer.first_nodes(), 8u);
  }
}

TEST(FirstPicture, DoesNotWaitForLightThatCameDamaged) {
  Sample sample;
  sample.file[sample.head] ^= 1;
  FirstAnswer answer(sample.file);
  answer.bring(65536, 200);
  EXPECT_TRUE(answer.opened());
  EXPECT_EQ(answer.first_nodes(), 8u);
}

}  // namespace
}  // namespace lightwell
