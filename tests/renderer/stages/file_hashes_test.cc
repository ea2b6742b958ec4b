// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/stages/file_hashes.h"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>

#include "calibration/files/sha256.h"
#include "calibration/files/whole_file.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

// Keeps the hash of `file` in `store`, then has the store say that it was read long after it
// changed.
void KeepAsAtRest(const fs::path& store, const fs::path& file) {
  FileHashes hashes(store);
  hashes.Hash(file);
  hashes.Save();
  const std::string text = ReadWhole(store);
  static const std::regex kReadTime(R"((\d{18,20})(,?\s*"[0-9a-f]{64}"))");
  WriteWhole(store, std::regex_replace(text, kReadTime, "9000000000000000000$2"));
}

TEST(FileHashes, AreThoseOfTheContentOrNothing) {
  const ScratchFolder folder;
  FileHashes hashes(folder.path() / "hashes.json");
  const fs::path file = folder.Write("a", "abc");
  EXPECT_EQ(hashes.Hash(file), Sha256(file));
  EXPECT_EQ(hashes.Hash(folder.path() / "missing"), "");
  EXPECT_EQ(hashes.Hash(folder.path()), "");
}

TEST(FileHashes, AFileAtRestIsNotReadAgain) {
  const ScratchFolder folder;
  const fs::path file = folder.Write("a", "abc"), store = folder.path() / "hashes.json";
  KeepAsAtRest(store, file);
  // The kept hash is told, which a false one in the store shows.
  WriteWhole(store, std::regex_replace(ReadWhole(store), std::regex("ba7816bf"), "00000000"));
  EXPECT_EQ(FileHashes(store).Hash(file).substr(0, 8), "00000000");
}

TEST(FileHashes, AFileThatChangedIsReadThoughSizeAndTimeAreTheSame) {
  const ScratchFolder folder;
  const fs::path file = folder.Write("a", "abc"), store = folder.path() / "hashes.json";
  KeepAsAtRest(store, file);
  const auto time = fs::last_write_time(file);
  std::ofstream(file) << "xyz";
  fs::last_write_time(file, time);
  EXPECT_EQ(FileHashes(store).Hash(file), Sha256(file));
}

TEST(FileHashes, WhatChangedJustBeforeItWasReadIsReadAgain) {
  const ScratchFolder folder;
  const fs::path file = folder.Write("a", "abc"), store = folder.path() / "hashes.json";
  {
    FileHashes hashes(store);
    hashes.Hash(file);
    hashes.Save();
  }
  WriteWhole(store, std::regex_replace(ReadWhole(store), std::regex("ba7816bf"), "00000000"));
  EXPECT_EQ(FileHashes(store).Hash(file), Sha256(file));
}

TEST(FileHashes, AStoreThatIsDamagedIsLeftAside) {
  const ScratchFolder folder;
  const fs::path file = folder.Write("a", "abc");
  for (const char* text : {"", "{", "[1]", "{\"version\": 1, \"files\": {\"/a\": [1]}}",
                           "{\"version\": 1, \"files\": {\"/a\": [\"x\",1,1,1,1,\"y\"]}}"}) {
    EXPECT_EQ(FileHashes(folder.Write("hashes.json", text)).Hash(file), Sha256(file)) << text;
  }
}

}  // namespace
}  // namespace insitu
