// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/editing/journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "calibration/files/whole_file.h"
#include "tests/reconstruction/editing/edited_site.h"

namespace insitu {
namespace {

using testing::HasSubstr;
using JournalOfSite = EditedSite;

TEST(Journal, GivesBackWhatWasAppended) {
  const ScratchFolder folder;
  const auto path = folder.path() / "work/prepare/journal.jsonl";
  const Json::Value entry = RowOf(R"({"a": 0.1, "b": "ü \"\\\n", "c": [null, true]})");
  {
    Journal journal(path);
    journal.Append(entry);
    journal.Append(entry);
  }
  const Journal journal(path);
  EXPECT_THAT(journal.entries(), testing::ElementsAre(entry, entry));
  EXPECT_FALSE(journal.remark());
}

TEST(Journal, RefusesALineBeforeTheLastThatIsNoEntry) {
  const ScratchFolder folder;
  const auto path = folder.Write("journal.jsonl", "{\"a\": 1}\n{\"a\n{\"a\": 1}\n");
  EXPECT_THAT(InputErrorOf([&] { Journal journal(path); }),
              HasSubstr("journal.jsonl:2: is no entry"));
}

TEST(Journal, ReadsTenThousandEntries) {
  const ScratchFolder folder;
  Json::Value entry;
  entry["kind"] = "edit";
  entry["operation"] =
      ToJson(OneEdit("1", "observations", MarkOn("A", "p", 1.25, 2), MarkOn("A", "p", 1, 2)));
  std::string text;
  for (int i = 0; i < 10000; ++i) text += OneLineJson(entry) + "\n";
  const auto path = folder.Write("journal.jsonl", text);
  const auto start = std::chrono::steady_clock::now();
  const Journal journal(path);
  std::printf("10 000 entries: %.3f s\n",
              std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  EXPECT_EQ(journal.entries().size(), 10000u);
}

// Power fails while the last line is written: each byte of it may be the last on disk.
TEST_F(JournalOfSite, TornAtAnyByteOfItsLastLineHoldsAllBefore) {
  Open();
  Apply("1", "observations", none_, MarkOn("B", "q", 1, 2));
  const std::string confirmed = OneLineJson(edit_->Tables());
  const std::filesystem::path path = site_.root / "work/prepare/journal.jsonl";
  const size_t size = ReadWhole(path).size();
  Apply("2", "observations", MarkOn("A", "p", 1.5, 2), none_);
  Kill();
  const std::string whole = ReadWhole(path);
  for (size_t bytes = size; bytes < whole.size(); ++bytes) {
    WriteWhole(path, whole.substr(0, bytes));
    Open();
    EXPECT_EQ(OneLineJson(edit_->Tables()), confirmed) << bytes;
    EXPECT_EQ(edit_->found().remarks.size(), bytes > size) << bytes;
    EXPECT_EQ(ReadWhole(path).size(), size);
    Kill();
  }
  WriteWhole(path, whole);
  Open();
  EXPECT_EQ(edit_->revision(), 2);
}

}  // namespace
}  // namespace insitu
