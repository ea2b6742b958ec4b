// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap/colmap_database.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "calibration/files/whole_file.h"
#include "reconstruction/colmap/sqlite_file.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kMaxImages = 2147483647;

// The tables of COLMAP 3.8; later versions add what they need.
constexpr char kTables[] = R"sql(
CREATE TABLE cameras (camera_id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL,
  model INTEGER NOT NULL, width INTEGER NOT NULL, height INTEGER NOT NULL, params BLOB,
  prior_focal_length INTEGER NOT NULL);
CREATE TABLE images (image_id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL,
  name TEXT NOT NULL UNIQUE, camera_id INTEGER NOT NULL, prior_qw REAL, prior_qx REAL,
  prior_qy REAL, prior_qz REAL, prior_tx REAL, prior_ty REAL, prior_tz REAL,
  CONSTRAINT image_id_check CHECK(image_id >= 0 and image_id < 2147483647),
  FOREIGN KEY(camera_id) REFERENCES cameras(camera_id));
CREATE UNIQUE INDEX index_name ON images(name);
CREATE TABLE keypoints (image_id INTEGER PRIMARY KEY NOT NULL, rows INTEGER NOT NULL,
  cols INTEGER NOT NULL, data BLOB,
  FOREIGN KEY(image_id) REFERENCES images(image_id) ON DELETE CASCADE);
CREATE TABLE descriptors (image_id INTEGER PRIMARY KEY NOT NULL, rows INTEGER NOT NULL,
  cols INTEGER NOT NULL, data BLOB,
  FOREIGN KEY(image_id) REFERENCES images(image_id) ON DELETE CASCADE);
CREATE TABLE matches (pair_id INTEGER PRIMARY KEY NOT NULL, rows INTEGER NOT NULL,
  cols INTEGER NOT NULL, data BLOB);
CREATE TABLE two_view_geometries (pair_id INTEGER PRIMARY KEY NOT NULL, rows INTEGER NOT NULL,
  cols INTEGER NOT NULL, data BLOB, config INTEGER NOT NULL, F BLOB, E BLOB, H BLOB, qvec BLOB,
  tvec BLOB);
)sql";

template <typename Value>
std::string_view Bytes(const Value* values, size_t count) {
  return {reinterpret_cast<const char*>(values), count * sizeof(Value)};
}

uint32_t Id(const SqliteStatement& row, int column) {
  const int64_t id = row.Integer(column);
  if (id < 0 || id > std::numeric_limits<uint32_t>::max()) {
    throw row.Error("id " + std::to_string(id) + ", expected one of 32 bits");
  }
  return static_cast<uint32_t>(id);
}

// rows x cols values in a blob, whose size must be that.
template <typename Value>
std::vector<Value> Values(const SqliteStatement& row, int64_t rows, int64_t cols, int blob) {
  const std::string_view bytes = row.Blob(blob);
  const auto held = static_cast<int64_t>(bytes.size() / sizeof(Value));
  const bool fits = rows >= 0 && cols >= 0 && cols <= 1000 && rows <= held &&
                    static_cast<size_t>(rows * cols) * sizeof(Value) == bytes.size();
  if (!fits) {
    throw row.Error(std::to_string(bytes.size()) + " bytes of data, expected those of " +
                    std::to_string(rows) + "x" + std::to_string(cols) + " values");
  }
  std::vector<Value> values(bytes.size() / sizeof(Value));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

void ReadCameras(SqliteFile* file, ColmapDatabase* database) {
  SqliteStatement row(file, "cameras",
                      "SELECT camera_id, model, width, height, params FROM cameras "
                      "ORDER BY camera_id");
  while (row.Step()) {
    const auto model = FindColmapLensModel(static_cast<int>(row.Integer(1)));
    if (!model) {
      throw row.Error("lens model " + std::to_string(row.Integer(1)) + " is not COLMAP's");
    }
    ColmapLens lens{model->name, static_cast<int>(row.Integer(2)), static_cast<int>(row.Integer(3)),
                    Values<double>(row, model->params, 1, 4)};
    if (lens.width <= 0 || lens.height <= 0) throw row.Error("expected an image size above 0");
    database->cameras[Id(row, 0)] = lens;
  }
}

bool HasColumn(SqliteFile* file, const std::string& table, const std::string& column) {
  SqliteStatement row(file, table, "SELECT 1 FROM pragma_table_info(?) WHERE name = ?");
  row.Bind(1, table);
  row.Bind(2, column);
  return row.Step();
}

void ReadImages(SqliteFile* file, ColmapDatabase* database) {
  const bool has_prior = HasColumn(file, "images", "prior_tx");  // until COLMAP 3.10
  SqliteStatement row(file, "images",
                      std::string("SELECT image_id, name, camera_id") +
                          (has_prior ? ", prior_tx, prior_ty, prior_tz" : "") +
                          " FROM images ORDER BY image_id");
  while (row.Step()) {
    ColmapDatabaseImage image{row.Text(1), Id(row, 2)};
    if (has_prior && row.Real(3) && row.Real(4) && row.Real(5)) {
      image.prior_center = Eigen::Vector3d(*row.Real(3), *row.Real(4), *row.Real(5));
    }
    if (!database->cameras.contains(image.camera)) {
      throw row.Error("image '" + image.name + "' has camera " + std::to_string(image.camera) +
                      ", which table cameras does not hold");
    }
    database->images[Id(row, 0)] = image;
  }
}

void ReadFeatures(SqliteFile* file, ColmapDatabase* database) {
  SqliteStatement row(file, "keypoints",
                      "SELECT image_id, rows, cols, data FROM keypoints ORDER BY image_id");
  while (row.Step()) {
    const uint32_t image = Id(row, 0);
    if (!database->images.contains(image)) {
      throw row.Error("keypoints of image " + std::to_string(image) +
                      ", which table images does not hold");
    }
    const int64_t rows = row.Integer(1), cols = row.Integer(2);
    if (rows > 0 && cols < 2) throw row.Error("expected x and y in the first two columns");
    const std::vector<float> values = Values<float>(row, rows, cols, 3);
    const Eigen::Map<const ColmapFeatures> features(values.data(), rows, cols);
    if (!features.allFinite()) throw row.Error("a keypoint that is not finite");
    database->features[image] = features;
  }
}

ColmapPair PairOf(const SqliteStatement& row) {
  const int64_t id = row.Integer(0);
  const auto first = static_cast<uint64_t>(id) / kMaxImages;
  const auto second = static_cast<uint64_t>(id) % kMaxImages;
  if (id < 0 || first >= second) {
    throw row.Error("pair_id " + std::to_string(id) +
                    ", expected 2147483647 first + second with "
                    "first < second");
  }
  return {static_cast<uint32_t>(first), static_cast<uint32_t>(second)};
}

ColmapMatches ReadMatches(const SqliteStatement& row, const ColmapPair& pair,
                          const ColmapDatabase& database) {
  const int64_t rows = row.Integer(1);
  const auto values = Values<uint32_t>(row, rows, rows == 0 ? 0 : 2, 3);
  ColmapMatches matches;
  for (size_t i = 0; i + 1 < values.size(); i += 2) matches.emplace_back(values[i], values[i + 1]);
  if (matches.empty()) return matches;
  for (const bool is_second : {false, true}) {
    const uint32_t image = is_second ? pair.second : pair.first;
    const auto features = database.features.find(image);
    const auto count = features == database.features.end() ? 0 : features->second.rows();
    for (const auto& match : matches) {
      if ((is_second ? match.second : match.first) < count) continue;
      throw row.Error("a match of a keypoint that image " + std::to_string(image) +
                      " does not have");
    }
  }
  return matches;
}

std::optional<Eigen::Matrix3d> ReadMatrix(const SqliteStatement& row, int column) {
  if (row.Blob(column).empty()) return std::nullopt;
  const auto values = Values<double>(row, 3, 3, column);
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values.data());
}

void ReadPairs(SqliteFile* file, ColmapDatabase* database) {
  SqliteStatement row(file, "matches",
                      "SELECT pair_id, rows, cols, data FROM matches ORDER BY pair_id");
  while (row.Step()) {
    const ColmapPair pair = PairOf(row);
    database->matches[pair] = ReadMatches(row, pair, *database);
  }
}

void ReadGeometries(SqliteFile* file, ColmapDatabase* database) {
  SqliteStatement row(file, "two_view_geometries",
                      "SELECT pair_id, rows, cols, data, config, F, E, H, qvec, tvec FROM "
                      "two_view_geometries ORDER BY pair_id");
  while (row.Step()) {
    const ColmapPair pair = PairOf(row);
    ColmapTwoViewGeometry geometry;
    geometry.config = static_cast<int>(row.Integer(4));
    geometry.inliers = ReadMatches(row, pair, *database);
    geometry.fundamental = ReadMatrix(row, 5);
    geometry.essential = ReadMatrix(row, 6);
    geometry.homography = ReadMatrix(row, 7);
    if (!row.Blob(8).empty() && !row.Blob(9).empty()) {
      const auto q = Values<double>(row, 4, 1, 8), t = Values<double>(row, 3, 1, 9);
      const Eigen::Quaterniond rotation(q[0], q[1], q[2], q[3]);
      if (rotation.norm() > 0)
        geometry.second_from_first = {rotation.normalized(), {t[0], t[1], t[2]}};
    }
    database->two_view_geometries[pair] = geometry;
  }
}

void WriteCamera(SqliteStatement* row, uint32_t id, const ColmapLens& lens) {
  const auto model = FindColmapLensModel(lens.model);
  INSITU_CHECK(model && static_cast<int>(lens.params.size()) == model->params);
  row->Reset();
  row->Bind(1, int64_t{model->id});
  row->Bind(2, int64_t{lens.width});
  row->Bind(3, int64_t{lens.height});
  row->BindBlob(4, Bytes(lens.params.data(), lens.params.size()));
  row->Bind(5, int64_t{id});
  row->Step();
}

void WriteImage(SqliteStatement* row, uint32_t id, const ColmapDatabaseImage& image) {
  row->Reset();
  row->Bind(1, int64_t{id});
  row->Bind(2, image.name);
  row->Bind(3, int64_t{image.camera});
  for (int i = 0; image.prior_center && i < 3; ++i) row->Bind(4 + i, (*image.prior_center)[i]);
  row->Step();
}

void WriteFeatures(SqliteStatement* row, uint32_t image, const ColmapFeatures& features) {
  row->Reset();
  row->Bind(1, int64_t{image});
  row->Bind(2, int64_t{features.rows()});
  row->Bind(3, int64_t{features.cols()});
  row->BindBlob(4, Bytes(features.data(), static_cast<size_t>(features.size())));
  row->Step();
}

void BindMatches(SqliteStatement* row, const ColmapPair& pair, const ColmapMatches& matches) {
  row->Reset();
  row->Bind(1, static_cast<int64_t>(ColmapPairId(pair)));
  row->Bind(2, static_cast<int64_t>(matches.size()));
  row->Bind(3, int64_t{2});
  std::vector<uint32_t> values;
  for (const auto& [first, second] : matches) values.insert(values.end(), {first, second});
  row->BindBlob(4, Bytes(values.data(), values.size()));
}

void WriteGeometry(SqliteStatement* row, const ColmapPair& pair,
                   const ColmapTwoViewGeometry& geometry) {
  BindMatches(row, pair, geometry.inliers);
  row->Bind(5, int64_t{geometry.config});
  const auto bind_matrix = [&](int parameter, const std::optional<Eigen::Matrix3d>& matrix) {
    if (!matrix) return;
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = *matrix;
    row->BindBlob(parameter, Bytes(rows.data(), 9));
  };
  bind_matrix(6, geometry.fundamental);
  bind_matrix(7, geometry.essential);
  bind_matrix(8, geometry.homography);
  if (geometry.second_from_first) {
    const auto& q = geometry.second_from_first->rotation;
    const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
    row->BindBlob(9, Bytes(wxyz, 4));
    row->BindBlob(10, Bytes(geometry.second_from_first->translation.data(), 3));
  }
  row->Step();
}

constexpr char kInsertFeatures[] =
    "INSERT OR REPLACE INTO keypoints(image_id, rows, cols, data) "
    "VALUES(?, ?, ?, ?)";

void WriteTables(SqliteFile* file, const ColmapDatabase& database) {
  SqliteStatement camera(file, "cameras",
                         "INSERT INTO cameras(model, width, height, params, camera_id, "
                         "prior_focal_length) VALUES(?, ?, ?, ?, ?, 1)");
  for (const auto& [id, lens] : database.cameras) WriteCamera(&camera, id, lens);
  SqliteStatement image(file, "images",
                        "INSERT INTO images(image_id, name, camera_id, prior_tx, prior_ty, "
                        "prior_tz) VALUES(?, ?, ?, ?, ?, ?)");
  for (const auto& [id, content] : database.images) WriteImage(&image, id, content);
  SqliteStatement features(file, "keypoints", kInsertFeatures);
  for (const auto& [id, content] : database.features) WriteFeatures(&features, id, content);
  SqliteStatement matches(file, "matches",
                          "INSERT INTO matches(pair_id, rows, cols, data) VALUES(?, ?, ?, ?)");
  for (const auto& [pair, content] : database.matches) {
    BindMatches(&matches, pair, content);
    matches.Step();
  }
  SqliteStatement geometry(file, "two_view_geometries",
                           "INSERT INTO two_view_geometries(pair_id, rows, cols, data, config, F, "
                           "E, H, qvec, tvec) VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  for (const auto& [pair, content] : database.two_view_geometries) {
    WriteGeometry(&geometry, pair, content);
  }
}

}  // namespace

uint64_t ColmapPairId(const ColmapPair& pair) {
  INSITU_CHECK(pair.first < pair.second && pair.second < kMaxImages);
  return kMaxImages * pair.first + pair.second;
}

ColmapDatabase ReadColmapDatabase(const fs::path& path) {
  SqliteFile file(path, SqliteFile::Mode::kRead);
  ColmapDatabase database;
  ReadCameras(&file, &database);
  ReadImages(&file, &database);
  ReadFeatures(&file, &database);
  ReadPairs(&file, &database);
  ReadGeometries(&file, &database);
  return database;
}

std::map<uint32_t, ColmapDescriptors> ReadColmapDescriptors(const fs::path& path,
                                                            const ColmapDatabase& database) {
  SqliteFile file(path, SqliteFile::Mode::kRead);
  SqliteStatement row(&file, "descriptors",
                      "SELECT image_id, rows, cols, data FROM descriptors ORDER BY image_id");
  std::map<uint32_t, ColmapDescriptors> descriptors;
  while (row.Step()) {
    const uint32_t image = Id(row, 0);
    const int64_t rows = row.Integer(1);
    const auto values = Values<uint8_t>(row, rows, rows == 0 ? 0 : 128, 3);
    const auto features = database.features.find(image);
    if (features == database.features.end() || features->second.rows() != rows) {
      throw row.Error(std::to_string(rows) + " descriptors of image " + std::to_string(image) +
                      ", expected one for each of its keypoints");
    }
    descriptors[image] = Eigen::Map<const ColmapDescriptors>(values.data(), rows, 128);
  }
  return descriptors;
}

void WriteColmapDatabase(const fs::path& path, const ColmapDatabase& database) {
  WriteWhole(path, [&](const fs::path& temporary) {
    SqliteFile file(temporary, SqliteFile::Mode::kCreate);
    file.Execute(std::string("BEGIN;") + kTables);
    WriteTables(&file, database);
    file.Execute("COMMIT");
  });
}

void UpdateColmapDatabase(const fs::path& path, const std::map<uint32_t, ColmapLens>& cameras,
                          const std::map<uint32_t, ColmapFeatures>& features) {
  SqliteFile file(path, SqliteFile::Mode::kChange);
  file.Execute("BEGIN");
  SqliteStatement camera(&file, "cameras",
                         "UPDATE cameras SET model = ?, width = ?, height = ?, params = ?, "
                         "prior_focal_length = 1 WHERE camera_id = ?");
  for (const auto& [id, lens] : cameras) WriteCamera(&camera, id, lens);
  SqliteStatement keypoints(&file, "keypoints", kInsertFeatures);
  for (const auto& [id, content] : features) WriteFeatures(&keypoints, id, content);
  file.Execute("COMMIT");
}

}  // namespace insitu
