// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/prepare_session.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "calibration/files/error.h"
#include "reconstruction/editing/edited_tables.h"
#include "reconstruction/editing/site_edit.h"
#include "renderer/live/live_worker.h"
#include "renderer/prepare/edit_messages.h"
#include "renderer/prepare/film_message.h"
#include "renderer/prepare/merge_conflicts.h"
#include "renderer/prepare/site_of_photos.h"
#include "renderer/prepare/to_do.h"

namespace insitu {
namespace {

constexpr auto kQuiet = std::chrono::milliseconds(40);  // after the last operation
constexpr auto kLook = std::chrono::seconds(1);         // between looks at the files

Json::Value OrNull(const std::optional<std::string>& text) {
  return text ? Json::Value(*text) : Json::Value();
}

}  // namespace

struct PrepareSession::Parts {
  Parts(const SitePaths& s, std::function<void(std::string)> tell,
        std::function<void(const std::string&)> w)
      : site(s),
        send(std::move(tell)),
        warn(std::move(w)),
        photos(PhotoNames(s)),
        edit(s, photos),
        worker(s),
        appearance(s, [this](const LiveAppearance& now, const Json::Value& message) {
          TellAppearance(now, message);
        }) {
    for (const Sentence& sentence : SentencesOf(edit.found())) warn(sentence.text());
    if (!read_only.empty()) warn(read_only);
  }

  const SitePaths site;
  const std::function<void(std::string)> send;
  const std::function<void(const std::string&)> warn;
  const std::vector<std::string> photos;
  const std::map<std::string, Eigen::Vector2i> sizes = PhotoSizes(site);

  std::atomic<int> news = 0;  // messages told

  std::mutex mutex;  // of all below but the worker, which only `thread` uses
  std::condition_variable_any changed;
  SiteEdit edit;
  std::shared_ptr<const LiveState> live = std::make_shared<LiveState>();
  Sentence not_saved;
  std::string read_only = ReadOnlyText(edit);
  std::string not_journalled;           // why the last operation was not taken
  std::set<std::string> warned_photos;  // with why
  bool is_due = true, forgets_stages = false;
  LiveWorker worker;
  AppearanceThread appearance;
  std::jthread thread;

  void Tell(const Json::Value& message) {
    ++news;  // before it is sent: a window that opens in between asks once too often
    send(OneLineJson(message));
  }

  Json::Value History() const {
    Json::Value json;
    json["undo"] = OrNull(edit.ToUndo());
    json["redo"] = OrNull(edit.ToRedo());
    return json;
  }

  Json::Value ToDoNow() const {
    const Json::Value tables = edit.Tables();
    std::vector<Sentence> faults = live->file_faults;
    if (const Sentence& fault = live->appearance.building_fault; !fault.empty()) {
      faults.push_back(fault);
    }
    return ToDo({site, tables, live->result.message, live->appearance.light,
                 FilmMessage(site, tables, sizes), std::move(faults)});
  }

  // Null where there is no film.
  Json::Value FilmNow() const { return FilmMessage(site, edit.Tables(), sizes); }

  void TellOperation(const Operation& operation, const char* kind) {
    Json::Value message;
    message["type"] = "op";
    message["revision"] = edit.revision();
    message["operation"] = ToJson(operation);
    message["kind"] = kind;
    message["history"] = History();
    Tell(message);
    const bool is_of_film =
        std::any_of(operation.edits.begin(), operation.edits.end(),
                    [](const RowEdit& change) { return IsOfFilm(change.table); });
    if (!is_of_film) return;
    Json::Value film = FilmNow();
    if (film.isNull()) film["type"] = "film";
    Tell(film);
  }

  static Answer Refused(int status, const Sentence& why) {
    Answer answer;
    answer.status = status;
    why.SayIn(&answer.body, "error");
    return answer;
  }

  Answer Done(const EditOutcome& outcome, const char* kind) {
    if (!outcome.refused.empty()) return Refused(400, outcome.refused);
    Answer answer;
    if (!outcome.conflicts.empty()) {
      answer.status = 409;
      answer.body["conflicts"] = ConflictsJson(outcome.conflicts);
      return answer;
    }
    not_journalled.clear();
    answer.body["revision"] = outcome.revision;
    if (outcome.is_repeated || !outcome.operation) return answer;
    answer.body["operation"] = ToJson(*outcome.operation);
    TellOperation(*outcome.operation, kind);
    is_due = true;
    changed.notify_all();
    return answer;
  }

  // A change that the journal cannot take, the disk being full, is not done: the page keeps it and
  // asks again.
  Answer Do(const std::function<EditOutcome()>& change, const char* kind) {
    try {
      return Done(change(), kind);
    } catch (const InputError& error) {
      if (std::exchange(not_journalled, error.what()) != error.what()) warn(error.what());
      return Refused(507, SentenceOf(error));
    }
  }

  // Why what an operation says of film cannot be in the site; empty if it can.
  Sentence RefusedFilm(const Operation& operation) const {
    for (const RowEdit& change : operation.edits) {
      if (IsOfFilm(change.table) && change.after.isObject()) return RefusalOfFilm(site);
    }
    return {};
  }

  void TellSentence(const char* type, const Sentence& sentence) {
    Json::Value message;
    message["type"] = type;
    sentence.SayIn(&message, "text");
    Tell(message);
    warn(sentence.text());
  }

  // True if the tables are others now.
  bool TellOutside(const OutsideChanges& outside) {
    for (const Operation& operation : outside.operations) TellOperation(operation, "outside");
    for (const Sentence& sentence : SentencesOf(outside)) TellSentence("outside", sentence);
    return !outside.operations.empty() || !outside.reread.empty();
  }

  // True if a file parses no more or again: then pages load everything anew.
  bool TellReread(const OutsideChanges& outside) {
    const std::string before = std::exchange(read_only, ReadOnlyText(edit));
    if (before == read_only && outside.reread.empty()) return false;
    if (before != read_only && !read_only.empty()) warn(read_only);
    Json::Value message;
    message["type"] = "reload";
    Tell(message);
    return true;
  }

  // False if a file cannot be written.
  bool SaveAndTell() {
    const SaveReport report = edit.Save();
    TellOutside(report.outside);
    const Sentence faults = NotSaved(report.faults);
    if (!faults.empty() && faults.text() != not_saved.text()) TellSentence("not_saved", faults);
    const bool was_saved = std::exchange(not_saved, faults).empty();
    if (!faults.empty()) return false;
    if (!was_saved) warn("all is saved again");
    Json::Value message;
    message["type"] = "saved";
    message["revision"] = edit.saved_revision();
    Tell(message);
    return true;
  }

  // Once each, and again after it was well.
  void WarnOfPhotos(const Json::Value& told) {
    std::set<std::string> faults;
    for (const Json::Value& photo : told) {
      const bool is_faulty = photo["needs_lens"].asBool() &&
                             photo["why_said"]["key"] != "noLens";  // that comes in good time
      if (!is_faulty) continue;
      const std::string fault = photo["why"].asString();
      faults.insert(fault);
      if (!warned_photos.contains(fault)) warn(fault);
    }
    warned_photos = std::move(faults);
  }

  // The light and the building stay those of the adjustment before until they are known anew; they
  // begin while the adjustment is still being told.
  void Solve(int revision) {
    const auto order = [&](int serial, const std::optional<SceneGeometry>& scene) {
      appearance.Order({serial, revision, scene});
    };
    auto state = std::make_shared<LiveState>(worker.Adjust(revision, order));
    {
      const std::lock_guard lock(mutex);
      state->appearance = live->appearance;
      live = state;
    }
    Tell(state->result.message);
    WarnOfPhotos(state->result.message["photos"]);
    TellToDo();
  }

  // By the thread that makes it.
  void TellAppearance(const LiveAppearance& now, const Json::Value& message) {
    {
      const std::lock_guard lock(mutex);
      auto state = std::make_shared<LiveState>(*live);
      state->appearance = now;
      live = std::move(state);
    }
    Tell(message);
    TellToDo();
  }

  void TellToDo() {
    Json::Value message;
    message["type"] = "todo";
    const std::lock_guard lock(mutex);
    message["todo"] = ToDoNow();
    Tell(message);
  }

  // Waits for something to do; the revision that the files hold, or nullopt at the end.
  std::optional<int> NextRevision(const std::stop_token& stop) {
    std::unique_lock lock(mutex);
    while (!stop.stop_requested()) {
      if (is_due) {
        is_due = false;
        if (changed.wait_for(lock, stop, kQuiet, [&] { return is_due; })) continue;
        SaveAndTell();
        if (std::exchange(forgets_stages, false)) {
          worker.ForgetStages();
          appearance.ForgetBuilding();
        }
        return edit.saved_revision();
      }
      if (changed.wait_for(lock, stop, kLook, [&] { return is_due; })) continue;
      if (stop.stop_requested()) break;
      const bool is_saved_at_last = !edit.is_saved() && SaveAndTell();
      const OutsideChanges outside = edit.Refresh();
      const bool is_reread = TellReread(outside);
      is_due = TellOutside(outside) || is_reread || is_saved_at_last;
    }
    return std::nullopt;
  }

  void Work(const std::stop_token& stop) {
    while (const auto revision = NextRevision(stop)) {
      try {
        Solve(*revision);
      } catch (const std::exception& error) {
        TellSentence("fault", SentenceOf(error));
      }
    }
    const std::lock_guard lock(mutex);
    SaveAndTell();
  }
};

PrepareSession::PrepareSession(const SitePaths& site, std::function<void(std::string)> send,
                               std::function<void(const std::string&)> warn)
    : parts_(std::make_unique<Parts>(site, std::move(send), std::move(warn))) {
  Parts& parts = *parts_;
  parts.thread = std::jthread([&parts](const std::stop_token& stop) { parts.Work(stop); });
}

PrepareSession::~PrepareSession() { Stop(); }

void PrepareSession::Stop() {
  if (!parts_->thread.joinable()) return;
  parts_->thread.request_stop();
  parts_->thread.join();
  parts_->appearance.Stop();
}

Json::Value PrepareSession::Site() {
  Parts& parts = *parts_;
  const std::lock_guard lock(parts.mutex);
  Json::Value site;
  site["news"] = parts.news.load();
  site["revision"] = parts.edit.revision();
  site["saved"] = parts.edit.saved_revision();
  parts.not_saved.SayIn(&site, "not_saved");
  site["name"] = std::filesystem::canonical(parts.site.root).filename().string();
  site["version"] = INSITU_VERSION;
  site["site_folder"] = std::filesystem::canonical(parts.site.root).string();
  site["tables"] = parts.edit.Tables();
  site["read_only"] = ReadOnlyJson(parts.edit);
  site["found"] = Json::Value(Json::arrayValue);
  for (const Sentence& sentence : SentencesOf(parts.edit.found())) {
    site["found"].append(sentence.ToJson());
  }
  site["merge"] = OpenMergeConflicts(parts.site, parts.edit);
  site["history"] = parts.History();
  site["adjusted"] = parts.live->result.message;
  site["light"] = parts.live->appearance.light;
  site["building"] = parts.live->appearance.building;
  site["film"] = parts.FilmNow();
  site["todo"] = parts.ToDoNow();
  return site;
}

PrepareSession::Answer PrepareSession::Apply(const Json::Value& operation) {
  const Operation asked = OperationFromJson(operation);
  const std::lock_guard lock(parts_->mutex);
  for (const Sentence& why : {OffFrame(asked, parts_->sizes), parts_->RefusedFilm(asked)}) {
    if (!why.empty()) return Parts::Refused(400, why);
  }
  return parts_->Do([&] { return parts_->edit.Apply(asked); }, "edit");
}

PrepareSession::Answer PrepareSession::Undo(const std::string& id) {
  const std::lock_guard lock(parts_->mutex);
  return parts_->Do([&] { return parts_->edit.Undo(id); }, "undo");
}

PrepareSession::Answer PrepareSession::Redo(const std::string& id) {
  const std::lock_guard lock(parts_->mutex);
  return parts_->Do([&] { return parts_->edit.Redo(id); }, "redo");
}

std::map<std::string, Eigen::Vector2d> PrepareSession::MarksOf(const std::string& point) const {
  const std::lock_guard lock(parts_->mutex);
  std::map<std::string, Eigen::Vector2d> marks;
  for (const Json::Value& row : parts_->edit.Rows("observations")) {
    if (row["point"] != point || row["state"] == "off") continue;
    marks[row["photo"].asString()] = {row["x"].asDouble(), row["y"].asDouble()};
  }
  return marks;
}

PrepareSession::Answer PrepareSession::TakeSite(const Json::Value& members,
                                                const std::string& label) {
  const std::lock_guard lock(parts_->mutex);
  const std::vector<Json::Value> rows = parts_->edit.Rows("site");
  const Json::Value before = rows.empty() ? Json::Value() : rows[0];
  Json::Value after = members;
  for (const std::string& name : before.getMemberNames()) after[name] = before[name];
  const std::string id = "exif-site-" + std::to_string(parts_->edit.revision());
  const Operation operation{id, label, {{"site", before, after}}};
  return parts_->Do([&] { return parts_->edit.Apply(operation); }, "outside");
}

void PrepareSession::Decided(const Json::Value& conflict) {
  const std::lock_guard lock(parts_->mutex);
  DropMergeConflict(parts_->site, conflict);
  Json::Value message;
  message["type"] = "merge";
  message["merge"] = OpenMergeConflicts(parts_->site, parts_->edit);
  parts_->Tell(message);
}

Json::Value PrepareSession::Hello() const {
  Json::Value message;
  message["type"] = "hello";
  message["news"] = parts_->news.load();
  return message;
}

std::shared_ptr<const LiveState> PrepareSession::live() const {
  const std::lock_guard lock(parts_->mutex);
  return parts_->live;
}

void PrepareSession::Reload() {
  const std::lock_guard lock(parts_->mutex);
  parts_->is_due = parts_->forgets_stages = true;
  parts_->changed.notify_all();
}

}  // namespace insitu
