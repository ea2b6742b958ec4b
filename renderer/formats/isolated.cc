// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/isolated.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <memory>
#include <new>
#include <stdexcept>

#include "calibration/files/error.h"

namespace insitu {
namespace {

// Writes and reads values through a pipe, as they stand in memory: both ends are one program.
class Sender {
 public:
  explicit Sender(FILE* stream) : stream_(stream) {}

  void Bytes(const void* data, size_t size) {
    if (size > 0 && std::fwrite(data, 1, size, stream_) != size) _exit(3);
  }
  template <typename T>
  void Plain(const T& value) {
    Bytes(&value, sizeof(value));
  }
  template <typename T>
  void Array(const std::vector<T>& values) {
    Plain(values.size());
    Bytes(values.data(), values.size() * sizeof(T));
  }
  void Text(const std::string& text) {
    Plain(text.size());
    Bytes(text.data(), text.size());
  }

 private:
  FILE* stream_;
};

class Receiver {
 public:
  explicit Receiver(FILE* stream) : stream_(stream) {}

  bool Bytes(void* data, size_t size) { return std::fread(data, 1, size, stream_) == size; }
  template <typename T>
  T Plain() {
    T value{};
    if (!Bytes(&value, sizeof(value))) complete_ = false;
    return complete_ ? value : T{};
  }
  template <typename T>
  std::vector<T> Array() {
    std::vector<T> values(Plain<size_t>());
    if (!Bytes(reinterpret_cast<char*>(values.data()), values.size() * sizeof(T))) {
      complete_ = false;
    }
    return values;
  }
  std::string Text() {
    std::string text(Plain<size_t>(), '\0');
    if (!Bytes(text.data(), text.size())) complete_ = false;
    return text;
  }
  bool complete() const { return complete_; }

 private:
  FILE* stream_;
  bool complete_ = true;
};

void Send(const SurfaceNames& names, Sender* out) {
  out->Text(names.layer);
  out->Text(names.block);
  out->Text(names.material);
  out->Plain(names.rgb.has_value());
  out->Plain(names.rgb.value_or(Eigen::Vector3d(Eigen::Vector3d::Zero())));
  out->Plain(names.opacity);
  out->Plain(names.is_solid);
  out->Plain(names.index);
  out->Plain(names.absorption_rgb);
  out->Plain(names.diffuse_weight);
  out->Plain(names.translucent_rgb);
  out->Text(names.texture);
  out->Text(names.texture_place);
  out->Plain(names.maps.size());
  for (const SurfaceMap& map : names.maps) {
    out->Plain(map.kind);
    out->Text(map.file);
    out->Plain(map.channel);
    out->Plain(map.factor);
    out->Plain(map.is_squared);
  }
}

SurfaceNames ReceiveNames(Receiver* in) {
  SurfaceNames names;
  names.layer = in->Text();
  names.block = in->Text();
  names.material = in->Text();
  const bool colored = in->Plain<bool>();
  const auto rgb = in->Plain<Eigen::Vector3d>();
  if (colored) names.rgb = rgb;
  names.opacity = in->Plain<double>();
  names.is_solid = in->Plain<bool>();
  names.index = in->Plain<double>();
  names.absorption_rgb = in->Plain<Eigen::Vector3d>();
  names.diffuse_weight = in->Plain<double>();
  names.translucent_rgb = in->Plain<Eigen::Vector3d>();
  names.texture = in->Text();
  names.texture_place = in->Text();
  for (auto left = in->Plain<size_t>(); left > 0 && in->complete(); --left) {
    SurfaceMap map;
    map.kind = in->Plain<SurfaceMap::Kind>();
    map.file = in->Text();
    map.channel = in->Plain<int>();
    map.factor = in->Plain<double>();
    map.is_squared = in->Plain<bool>();
    names.maps.push_back(map);
  }
  return names;
}

void Send(const ModelLamp& lamp, Sender* out) {
  out->Text(lamp.name);
  out->Plain(lamp.position);
  out->Plain(lamp.direction);
  out->Plain(lamp.rgb);
  out->Plain(lamp.candela);
  out->Plain(lamp.inner_deg);
  out->Plain(lamp.outer_deg);
}

ModelLamp ReceiveLamp(Receiver* in) {
  ModelLamp lamp;
  lamp.name = in->Text();
  lamp.position = in->Plain<Eigen::Vector3d>();
  lamp.direction = in->Plain<Eigen::Vector3d>();
  lamp.rgb = in->Plain<Eigen::Vector3d>();
  lamp.candela = in->Plain<double>();
  lamp.inner_deg = in->Plain<std::optional<double>>();
  lamp.outer_deg = in->Plain<std::optional<double>>();
  return lamp;
}

void Send(const Model& model, Sender* out) {
  out->Plain(model.mesh.surfaces.size());
  for (const SurfaceNames& names : model.mesh.surfaces) Send(names, out);
  out->Array(model.mesh.vertices);
  out->Array(model.mesh.triangles);
  out->Array(model.mesh.surface_of_triangle);
  out->Array(model.mesh.corner_normals);
  out->Array(model.mesh.corner_uvs);
  out->Array(model.mesh.spheres);
  out->Text(model.format);
  out->Plain(model.metres_per_unit.has_value());
  out->Plain(model.metres_per_unit.value_or(1));
  out->Plain(model.entities.size());
  for (const auto& [kind, count] : model.entities) {
    out->Text(kind);
    out->Plain(count);
  }
  out->Plain(model.skipped.size());
  for (const auto& [what, count] : model.skipped) {
    out->Text(what.first);
    out->Text(what.second);
    out->Plain(count);
  }
  out->Plain(model.images.size());
  for (const auto& [name, image] : model.images) {
    out->Text(name);
    out->Text(image);
  }
  out->Plain(model.lamps.size());
  for (const ModelLamp& lamp : model.lamps) Send(lamp, out);
  out->Plain(model.files.size());
  for (const auto& file : model.files) out->Text(file.string());
  out->Plain(model.degenerate_faces);
  out->Plain(model.warnings.size());
  for (const std::string& warning : model.warnings) out->Text(warning);
}

Model ReceiveModel(Receiver* in) {
  Model model;
  for (size_t n = in->Plain<size_t>(); n > 0 && in->complete(); --n) {
    model.mesh.surfaces.push_back(ReceiveNames(in));
  }
  model.mesh.vertices = in->Array<Eigen::Vector3d>();
  model.mesh.triangles = in->Array<Eigen::Vector3i>();
  model.mesh.surface_of_triangle = in->Array<int>();
  model.mesh.corner_normals = in->Array<Eigen::Vector3f>();
  model.mesh.corner_uvs = in->Array<Eigen::Vector2f>();
  model.mesh.spheres = in->Array<ModelSphere>();
  model.format = in->Text();
  const bool has_unit = in->Plain<bool>();
  const auto unit = in->Plain<double>();
  if (has_unit) model.metres_per_unit = unit;
  for (size_t n = in->Plain<size_t>(); n > 0 && in->complete(); --n) {
    const std::string kind = in->Text();
    model.entities[kind] = in->Plain<int>();
  }
  for (size_t n = in->Plain<size_t>(); n > 0 && in->complete(); --n) {
    const std::string kind = in->Text();
    const std::string reason = in->Text();
    model.skipped[{kind, reason}] = in->Plain<int>();
  }
  for (size_t n = in->Plain<size_t>(); n > 0 && in->complete(); --n) {
    const std::string name = in->Text();
    model.images[name] = in->Text();
  }
  for (size_t n = in->Plain<size_t>(); n > 0 && in->complete(); --n) {
    model.lamps.push_back(ReceiveLamp(in));
  }
  for (size_t n = in->Plain<size_t>(); n > 0 && in->complete(); --n) {
    model.files.emplace_back(in->Text());
  }
  model.degenerate_faces = in->Plain<int>();
  for (size_t n = in->Plain<size_t>(); n > 0 && in->complete(); --n) {
    model.warnings.push_back(in->Text());
  }
  return model;
}

// A child whose memory a faulty file has damaged may send anything.
bool IsSound(const Model& model) {
  const ModelMesh& mesh = model.mesh;
  const auto corners = 3 * mesh.triangles.size();
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    const int last = static_cast<int>(mesh.vertices.size()) - 1;
    if (triangle.minCoeff() < 0 || triangle.maxCoeff() > last) return false;
  }
  for (const int surface : mesh.surface_of_triangle) {
    if (surface < 0 || surface >= static_cast<int>(mesh.surfaces.size())) return false;
  }
  for (const ModelSphere& sphere : mesh.spheres) {
    if (sphere.surface < 0 || sphere.surface >= static_cast<int>(mesh.surfaces.size()))
      return false;
  }
  return mesh.surface_of_triangle.size() == mesh.triangles.size() &&
         (mesh.corner_normals.empty() || mesh.corner_normals.size() == corners) &&
         (mesh.corner_uvs.empty() || mesh.corner_uvs.size() == corners);
}

std::optional<Model> ReceiveSoundModel(Receiver* in) try {
  Model model = ReceiveModel(in);
  if (!in->complete() || !IsSound(model)) return std::nullopt;
  return model;
} catch (const std::bad_alloc&) {
  return std::nullopt;
} catch (const std::length_error&) {
  return std::nullopt;
}

void LimitMemory([[maybe_unused]] const IsolationLimits& limits) {
#ifndef INSITU_SANITIZED  // sanitizers reserve terabytes
  std::ifstream file("/proc/self/statm");
  int64_t pages = 0;
  file >> pages;
  const auto bytes = static_cast<rlim_t>(pages * sysconf(_SC_PAGESIZE) + limits.bytes);
  const rlimit space{bytes, bytes};
  setrlimit(RLIMIT_AS, &space);
#endif
}

void Limit(const IsolationLimits& limits) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody waits for it then
  const auto seconds = static_cast<rlim_t>(limits.seconds);
  const rlimit cpu{seconds, seconds + 1};
  setrlimit(RLIMIT_CPU, &cpu);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  LimitMemory(limits);
}

// The child's whole life.
[[noreturn]] void RunChild(const std::function<Model()>& read, const IsolationLimits& limits,
                           int pipe_end) {
  if (!std::freopen("/dev/null", "w", stderr)) _exit(3);
  Limit(limits);
  FILE* stream = fdopen(pipe_end, "wb");
  Sender out(stream);
  try {
    const Model model = read();
    out.Plain('m');
    Send(model, &out);
  } catch (const std::bad_alloc&) {
    out.Plain('f');
    out.Text("needs more memory than the program allows it");
  } catch (const std::exception& exception) {
    out.Plain('f');
    out.Text(exception.what());
  } catch (...) {
    out.Plain('f');
    out.Text("an unknown failure");
  }
  std::fflush(stream);
  _exit(0);
}

std::string EndOf(int status, const IsolationLimits& limits) {
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)) {
    return "takes longer than " + std::to_string(limits.seconds) + " s";
  }
  if (WIFSIGNALED(status)) {
    return std::string("breaks its reader (") + strsignal(WTERMSIG(status)) + ")";
  }
  return "breaks its reader";
}

}  // namespace

void IsolationLimits::Check() const {
  INSITU_CHECK(seconds > 0);
  INSITU_CHECK(bytes > 0);
}

IsolatedModel ReadIsolated(const std::function<Model()>& read, const IsolationLimits& limits) {
  limits.Check();
  int ends[2];
  INSITU_CHECK(pipe(ends) == 0);
  std::fflush(nullptr);
  const pid_t child = fork();
  INSITU_CHECK(child >= 0);
  if (child == 0) {
    close(ends[0]);
    RunChild(read, limits, ends[1]);
  }
  close(ends[1]);
  IsolatedModel result;
  {
    const std::unique_ptr<FILE, int (*)(FILE*)> stream(fdopen(ends[0], "rb"), &std::fclose);
    Receiver in(stream.get());
    const char kind = in.Plain<char>();
    if (kind == 'm') result.model = ReceiveSoundModel(&in);
    if (kind == 'f') result.failure = in.Text();
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (!result.model && result.failure.empty()) result.failure = EndOf(status, limits);
  return result;
}

}  // namespace insitu
