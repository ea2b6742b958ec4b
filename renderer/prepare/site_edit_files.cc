// SPDX-License-Identifier: GPL-3.0-or-later
// Of SiteEdit what passes between the tables and the files.
#include <algorithm>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/sha256.h"
#include "calibration/files/whole_file.h"
#include "renderer/prepare/merge_rows.h"
#include "renderer/prepare/site_edit.h"

namespace insitu {
namespace {

constexpr int kMostTries = 5;  // at writing a file that others write at the same time

std::filesystem::path PrepareFolder(const SitePaths& site) { return site.root / "work/prepare"; }

std::string HashOf(const std::string& text) { return text.empty() ? "" : Sha256OfText(text); }

// The last mark of that content; nullptr: none.
const FileMark* MarkOf(const std::vector<FileMark>& marks, const std::string& hash) {
  const auto mark = std::find_if(marks.rbegin(), marks.rend(),
                                 [&](const FileMark& each) { return each.hash == hash; });
  return mark == marks.rend() ? nullptr : &*mark;
}

Operation OutsideOperation(const SiteFile& file, int revision, std::vector<RowEdit> edits) {
  const std::string number = std::to_string(revision + 1);
  return {"outside " + number, "Changed in " + file.name + " by another program", std::move(edits)};
}

template <typename Items>
void AppendTo(Items& items, const Items& more) {
  items.insert(items.end(), more.begin(), more.end());
}

}  // namespace

SiteEdit::SiteEdit(SitePaths site, std::vector<std::string> photos)
    : site_(std::move(site)),
      photos_(std::move(photos)),
      lock_(site_, "insitu-prepare", PrepareFolder(site_) / ".lock"),
      history_(PrepareFolder(site_) / "journal.jsonl"),
      files_(SiteFiles(site_.root, PrepareFolder(site_) / "files")) {
  if (history_.remark()) found_.remarks.push_back(*history_.remark());
  RemoveLeftovers(site_.survey());
  RemoveLeftovers(PrepareFolder(site_));
  const int before = revision();
  for (SiteFile& file : files_) Open(file);
  history_.ForgetDone();
  saved_revision_ = is_saved() ? revision() : std::min(before, revision());
  for (const SiteFile& file : files_) {
    const auto& marks = history_.MarksOf(file.name);
    if (file.is_changed && !marks.empty()) {
      saved_revision_ = std::min(saved_revision_, marks.back().revision);
    }
  }
}

// The file's content as its tables, without what the journal has on top.
void SiteEdit::ReadFirst(SiteFile& file, const std::string& on_disk) {
  try {
    file.now = MakeSurveyText(file.tables, file.path, on_disk);
    file.on_disk = on_disk;
    file.was_read = true;
  } catch (const InputError& error) {
    file.now = MakeSurveyText(file.tables, file.path, "");
    file.fault = FaultOf(file, error);
  }
}

// Finds which revision a content is of, ours as it was last written or as the copy has it, and does
// again what followed; then takes in what others did to the file since.
void SiteEdit::Open(SiteFile& file) {
  std::string on_disk, copy;
  try {
    on_disk = ReadIfThere(file.path);
    copy = ReadIfThere(file.copy);
  } catch (const InputError& error) {
    ReadFirst(file, "");
    file.was_read = false;
    file.fault = FaultOf(file, error);
    return;
  }
  const std::vector<FileMark>& marks = history_.MarksOf(file.name);
  const FileMark* of_copy = MarkOf(marks, HashOf(copy));
  const bool is_ours = !marks.empty() && marks.back().hash == HashOf(on_disk);
  const bool has_copy = !is_ours && of_copy;
  ReadFirst(file, has_copy ? copy : on_disk);
  if (file.fault) return;
  if (!marks.empty()) Replay(file, has_copy ? of_copy->revision : marks.back().revision);
  if (on_disk != file.on_disk) TakeIn(file, on_disk, &found_);
  if (!file.is_changed && !file.fault) RememberOnDisk(file);
}

void SiteEdit::Replay(SiteFile& file, int revision) {
  const auto text_of = [&](const EditedTable&) -> SurveyText& { return *file.now; };
  for (const DoneEdits& done : history_.done()) {
    if (done.revision <= revision) continue;
    for (size_t i = 0; i < done.edits.size(); ++i) {
      const EditedTable& table = *FindEditedTable(done.edits[i].table);
      if (table.file != file.name) continue;
      file.is_changed = true;
      const std::vector<Json::Value> trace = {i < done.traces.size() ? done.traces[i]
                                                                     : Json::Value()};
      AppendTo(found_.conflicts,
               ApplyEdits({done.edits[i]}, text_of, EqualRows::kAllowed, trace).conflicts);
    }
  }
  if (file.is_changed) file.is_changed = file.now->text() != file.on_disk;
}

void SiteEdit::TakeIn(SiteFile& file, const std::string& on_disk, OutsideChanges* changes) {
  if (on_disk.empty() && file.was_read) {
    file.on_disk.clear();
    file.is_changed = true;
    changes->remarks.push_back(file.name + " was removed; it is written again");
    return;
  }
  if (!file.was_read) {
    ReadFirst(file, on_disk);
    if (!file.was_read) return;
    changes->reread.push_back(file.name);
  } else if (!MergeIn(file, on_disk, changes)) {
    return;
  }
  file.fault.reset();
  file.is_changed = file.now->text() != on_disk;
}

// False: the content cannot be understood.
bool SiteEdit::MergeIn(SiteFile& file, const std::string& on_disk, OutsideChanges* changes) {
  MergedText merged;
  try {
    merged = MergeText(file.tables, file.path, file.on_disk, *file.now, on_disk);
  } catch (const InputError& error) {
    file.fault = FaultOf(file, error);
    return false;
  }
  if (!merged.outside.empty()) {
    const Operation operation = OutsideOperation(file, revision(), merged.outside);
    history_.AddOutside(operation);
    changes->operations.push_back(operation);
  }
  AppendTo(changes->conflicts, merged.conflicts);
  file.now = std::move(merged.text);
  file.on_disk = on_disk;
  return true;
}

// So that the next start knows what this content was.
void SiteEdit::RememberOnDisk(const SiteFile& file) {
  Remember(file, file.on_disk);
  if (const auto other = ReplaceFile(file.copy, file.on_disk, ReadIfThere(file.copy))) {
    throw InputError(file.copy, "is written by another program");
  }
}

void SiteEdit::Remember(const SiteFile& file, const std::string& text) {
  const std::vector<FileMark>& marks = history_.MarksOf(file.name);
  const std::string hash = HashOf(text);
  if (marks.empty() || marks.back().hash != hash) history_.AddMark(file.name, hash);
}

OutsideChanges SiteEdit::Refresh() {
  OutsideChanges changes;
  for (SiteFile& file : files_) {
    try {
      const auto on_disk = ReadIfWritten(file);
      if (!on_disk) continue;
      TakeIn(file, *on_disk, &changes);
      if (!file.is_changed && !file.fault) RememberOnDisk(file);
    } catch (const std::exception& error) {
      changes.remarks.emplace_back(error.what());
    }
  }
  return changes;
}

void SiteEdit::SaveFile(SiteFile& file, SaveReport* report) {
  for (int tries = 0; tries < kMostTries; ++tries) {
    std::string other = ReadIfThere(file.path);
    if (other == file.on_disk) {
      const std::string text = file.now->text();
      if (text == file.on_disk) break;
      Remember(file, text);
      if (const auto meanwhile = ReplaceFile(file.path, text, file.on_disk)) {
        other = *meanwhile;
      } else {
        file.on_disk = text;
        report->written.push_back(file.name);
        break;
      }
    }
    TakeIn(file, other, &report->outside);
    if (file.fault) {
      report->faults.push_back(*file.fault);
      return;
    }
  }
  if (file.now->text() != file.on_disk) {
    throw InputError(file.path, "is written by another program all the time");
  }
  file.is_changed = false;
  file.seen = {};
  file.is_settled = false;
  RememberOnDisk(file);
}

SaveReport SiteEdit::Save() {
  SaveReport report;
  for (SiteFile& file : files_) {
    if (!file.is_changed) continue;
    try {
      SaveFile(file, &report);
    } catch (const std::exception& error) {
      report.faults.push_back(FaultOf(file, error));
    }
  }
  if (report.is_saved()) saved_revision_ = revision();
  return report;
}

}  // namespace insitu
