// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/sentence.h"

#include <gtest/gtest.h>

#include "calibration/files/error.h"

namespace insitu {
namespace {

TEST(Sentence, IsEnglishAndItsKeyWithValues) {
  const Sentence rays("rays", "{n} rays of {name}", {{"n", 2}, {"name", "p"}});
  EXPECT_EQ(rays.text(), "2 rays of p");
  const Json::Value json = rays.ToJson();
  EXPECT_EQ(json["text"], "2 rays of p");
  EXPECT_EQ(json["text_said"]["key"], "rays");
  EXPECT_EQ(json["text_said"]["values"]["n"], 2);
}

TEST(Sentence, HoldsOthers) {
  const Sentence inner("inner", "one ray");
  const Sentence outer("outer", "{name}: {reason}", {{"name", "{n}"}, {"reason", inner.ToJson()}});
  EXPECT_EQ(outer.text(), "{n}: one ray");
  EXPECT_EQ(outer.ToJson()["text_said"]["values"]["reason"]["text_said"]["key"], "inner");
}

TEST(Sentence, VerbatimHasNoKey) {
  Json::Value object;
  Sentence::Verbatim("a.csv:3: {x}").SayIn(&object, "why");
  EXPECT_EQ(object["why"], "a.csv:3: {x}");
  EXPECT_FALSE(object.isMember("why_said"));
}

TEST(Sentence, WantsAPlaceForEachValue) {
  EXPECT_THROW(Sentence("key", "{n} rays", {{"m", 2}}), CheckError);
}

}  // namespace
}  // namespace insitu
