// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/prepare_session.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/photo/photograph.h"
#include "reconstruction/editing/edited_tables.h"
#include "reconstruction/editing/site_edit.h"
#include "renderer/live/live_worker.h"
#include "renderer/prepare/film_message.h"
#include "renderer/prepare/to_do.h"

namespace insitu {
namespace {

constexpr auto kQuiet = std::chrono::milliseconds(60);  // after the last operation
constexpr auto kLook = std::chrono::seconds(1);         // between looks at the files

std::vector<std::string> NamesOf(const SitePaths& site) {
  std::vector<std::string> names;
  for (const auto& path : ListPhotographs(site)) names.push_back(path.stem().string());
  return names;
}

Json::Value ConflictsJson(const std::vector<RowConflict>& conflicts) {
  Json::Value json(Json::arrayValue);
  for (const RowConflict& conflict : conflicts) json.append(ToJson(conflict));
  return json;
}

// By name; photographs that cannot be read have none.
std::map<std::string, Eigen::Vector2i> SizesOf(const SitePaths& site) {
  std::map<std::string, Eigen::Vector2i> sizes;
  for (const auto& path : ListPhotographs(site)) {
    try {
      sizes[path.stem().string()] = ReadPhotographSize(path);
    } catch (const InputError&) {  // the page shows that it cannot be shown
    }
  }
  return sizes;
}

Json::Value OrNull(const std::optional<std::string>& text) {
  return text ? Json::Value(*text) : Json::Value();
}

}  // namespace

struct PrepareSession::Parts {
  Parts(const SitePaths& s, std::function<void(std::string)> tell)
      : site(s), send(std::move(tell)), photos(NamesOf(s)), edit(s, photos), worker(s) {}

  const SitePaths site;
  const std::function<void(std::string)> send;
  const std::vector<std::string> photos;
  const std::map<std::string, Eigen::Vector2i> sizes = SizesOf(site);

  std::mutex mutex;  // of all below but the worker, which only the thread uses
  std::condition_variable_any changed;
  SiteEdit edit;
  std::shared_ptr<const LiveState> live = std::make_shared<LiveState>();
  std::string not_saved;
  std::string read_only = ReadOnly();
  bool is_due = true, forgets_stages = false;
  LiveWorker worker;
  std::jthread thread;

  void Tell(const Json::Value& message) const { send(OneLineJson(message)); }

  Json::Value History() const {
    Json::Value json;
    json["undo"] = OrNull(edit.ToUndo());
    json["redo"] = OrNull(edit.ToRedo());
    return json;
  }

  Json::Value ToDoNow() const {
    const Json::Value tables = edit.Tables();
    return ToDo({site, tables, live->result.message, live->light, FilmMessage(site, tables, sizes),
                 live->file_faults});
  }

  // Null where there is no film.
  Json::Value FilmNow() const { return FilmMessage(site, edit.Tables(), sizes); }

  void TellOperation(const Operation& operation, const char* kind) const {
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

  Answer Done(const EditOutcome& outcome, const char* kind) {
    Answer answer;
    if (!outcome.refused.empty()) {
      answer.status = 400;
      answer.body["error"] = outcome.refused;
      return answer;
    }
    if (!outcome.conflicts.empty()) {
      answer.status = 409;
      answer.body["conflicts"] = ConflictsJson(outcome.conflicts);
      return answer;
    }
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
      Answer answer;
      answer.status = 507;
      answer.body["error"] = error.what();
      return answer;
    }
  }

  // Files that do not parse, and why.
  std::string ReadOnly() const {
    std::string text;
    for (const ReadOnlyTable& table : edit.read_only()) {
      const FileFault& fault = table.fault;
      text += fault.file + ":" + std::to_string(fault.line) + ": " + fault.text + "\n";
    }
    return text;
  }

  // Why what an operation says of film cannot be in the site; "" if it can.
  std::string RefusedFilm(const Operation& operation) const {
    for (const RowEdit& change : operation.edits) {
      if (IsOfFilm(change.table) && change.after.isObject()) return RefusalOfFilm(site);
    }
    return "";
  }

  // Of the pixels that an operation places; "" if all lie on their photographs.
  std::string OffFrame(const Operation& operation) const {
    for (const RowEdit& change : operation.edits) {
      if (change.table == "camera_positions") continue;  // its x and y are metres
      const Json::Value& row = change.after;
      if (!row.isObject() || !row["photo"].isString() || !row["x"].isNumeric()) continue;
      const auto size = sizes.find(row["photo"].asString());
      if (size == sizes.end()) continue;
      const Eigen::Array2d pixel(row["x"].asDouble(), row["y"].asDouble());
      const bool is_on =
          (pixel >= -0.5).all() && (pixel <= size->second.cast<double>().array() - 0.5).all();
      if (!is_on) return change.table + ": the pixel lies off photo " + size->first;
    }
    return "";
  }

  void TellText(const char* type, const std::string& text) const {
    Json::Value message;
    message["type"] = type;
    message["text"] = text;
    Tell(message);
  }

  // True if the tables are others now.
  bool TellOutside(const OutsideChanges& outside) const {
    for (const Operation& operation : outside.operations) TellOperation(operation, "outside");
    for (const std::string& remark : outside.remarks) TellText("outside", remark);
    for (const RowConflict& conflict : outside.conflicts) {
      TellText("outside", conflict.table +
                              ": a row was changed here and in the file; the file's stands, "
                              "yours was " +
                              OneLineJson(conflict.after));
    }
    return !outside.operations.empty() || !outside.reread.empty();
  }

  // True if a file parses no more or again: then pages load everything anew.
  bool TellReread(const OutsideChanges& outside) {
    const std::string before = std::exchange(read_only, ReadOnly());
    if (before == read_only && outside.reread.empty()) return false;
    Json::Value message;
    message["type"] = "reload";
    Tell(message);
    return true;
  }

  // False if a file cannot be written.
  bool SaveAndTell() {
    const SaveReport report = edit.Save();
    TellOutside(report.outside);
    std::string faults;
    for (const FileFault& fault : report.faults) faults += fault.file + ": " + fault.text + "\n";
    if (!faults.empty() && faults != not_saved) TellText("not_saved", faults);
    not_saved = faults;
    if (!faults.empty()) return false;
    Json::Value message;
    message["type"] = "saved";
    message["revision"] = edit.saved_revision();
    Tell(message);
    return true;
  }

  void Publish(const std::shared_ptr<const LiveState>& state) {
    const std::lock_guard lock(mutex);
    live = state;
  }

  void Solve(int revision) {
    auto state = std::make_shared<LiveState>(worker.Adjust(revision));
    Publish(state);
    Tell(state->result.message);
    TellToDo();
    auto lit = std::make_shared<LiveState>(*state);
    worker.AddLight(revision, lit.get());
    if (!lit->light.isNull()) Tell(lit->light);
    worker.AddBuilding(lit.get());
    if (!lit->building.isNull()) Tell(lit->building);
    Publish(lit);
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
        if (std::exchange(forgets_stages, false)) worker.ForgetStages();
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
        TellText("fault", error.what());
      }
    }
    const std::lock_guard lock(mutex);
    SaveAndTell();
  }
};

PrepareSession::PrepareSession(const SitePaths& site, std::function<void(std::string)> send)
    : parts_(std::make_unique<Parts>(site, std::move(send))) {
  Parts& parts = *parts_;
  parts.thread = std::jthread([&parts](const std::stop_token& stop) { parts.Work(stop); });
}

PrepareSession::~PrepareSession() { Stop(); }

void PrepareSession::Stop() {
  if (!parts_->thread.joinable()) return;
  parts_->thread.request_stop();
  parts_->thread.join();
}

Json::Value PrepareSession::Site() {
  Parts& parts = *parts_;
  const std::lock_guard lock(parts.mutex);
  Json::Value site;
  site["revision"] = parts.edit.revision();
  site["saved"] = parts.edit.saved_revision();
  site["not_saved"] = parts.not_saved;
  site["name"] = std::filesystem::canonical(parts.site.root).filename().string();
  site["version"] = INSITU_VERSION;
  site["site_folder"] = std::filesystem::canonical(parts.site.root).string();
  site["tables"] = parts.edit.Tables();
  site["read_only"] = Json::Value(Json::arrayValue);
  for (const ReadOnlyTable& table : parts.edit.read_only()) {
    Json::Value json;
    json["table"] = table.table;
    json["file"] = table.fault.file;
    json["line"] = table.fault.line;
    json["text"] = table.fault.text;
    site["read_only"].append(json);
  }
  site["history"] = parts.History();
  site["adjusted"] = parts.live->result.message;
  site["light"] = parts.live->light;
  site["building"] = parts.live->building;
  site["film"] = parts.FilmNow();
  site["todo"] = parts.ToDoNow();
  return site;
}

PrepareSession::Answer PrepareSession::Apply(const Json::Value& operation) {
  const Operation asked = OperationFromJson(operation);
  const std::lock_guard lock(parts_->mutex);
  EditOutcome refusal;
  refusal.refused = parts_->OffFrame(asked);
  if (refusal.is_done()) refusal.refused = parts_->RefusedFilm(asked);
  if (!refusal.is_done()) return parts_->Done(refusal, "edit");
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

PrepareSession::Answer PrepareSession::TakeSite(const Json::Value& members) {
  const std::lock_guard lock(parts_->mutex);
  const std::vector<Json::Value> rows = parts_->edit.Rows("site");
  const Json::Value before = rows.empty() ? Json::Value() : rows[0];
  Json::Value after = members;
  for (const std::string& name : before.getMemberNames()) after[name] = before[name];
  const std::string id = "exif-site-" + std::to_string(parts_->edit.revision());
  const Operation operation{id, "Place and time from EXIF", {{"site", before, after}}};
  return parts_->Do([&] { return parts_->edit.Apply(operation); }, "outside");
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
