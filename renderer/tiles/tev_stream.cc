// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/tiles/tev_stream.h"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "calibration/files/error.h"

namespace insitu {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr uint8_t kCreateImage = 4, kUpdateImageV3 = 6;
constexpr int kConnectMs = 3000;
constexpr int kChannels = 3;

template <typename Number>
void Put(Number number, std::string* packet) {
  packet->append(reinterpret_cast<const char*>(&number), sizeof(number));
}

void PutText(const std::string& text, std::string* packet) {
  packet->append(text.c_str(), text.size() + 1);
}

// A packet's kind, whether the viewer turns to the image, its name and channels come first.
std::string PacketOf(uint8_t kind, bool takes_focus, const std::string& name) {
  std::string packet;
  Put(kind, &packet);
  Put(static_cast<uint8_t>(takes_focus), &packet);
  PutText(name, &packet);
  return packet;
}

void PutChannels(std::string* packet) {
  Put(int32_t{kChannels}, packet);
  for (const char* channel : {"R", "G", "B"}) PutText(channel, packet);
}

std::string WithLength(const std::string& packet) {
  std::string whole;
  Put(static_cast<uint32_t>(sizeof(uint32_t) + packet.size()), &whole);
  return whole + packet;
}

std::string CreateImage(const std::string& name, const Raster& photo) {
  std::string packet = PacketOf(kCreateImage, true, name);
  Put(int32_t{photo.width}, &packet);
  Put(int32_t{photo.height}, &packet);
  PutChannels(&packet);
  return WithLength(packet);
}

// `rgb`: of the tile, row by row.
std::string UpdateImage(const std::string& name, const Tile& tile, const std::vector<float>& rgb) {
  std::string packet = PacketOf(kUpdateImageV3, false, name);
  PutChannels(&packet);
  for (const int32_t side : {tile.left, tile.top, tile.right - tile.left, tile.bottom - tile.top}) {
    Put(side, &packet);
  }
  for (int64_t channel = 0; channel < kChannels; ++channel) Put(channel, &packet);  // offsets
  for (int channel = 0; channel < kChannels; ++channel)
    Put(int64_t{kChannels}, &packet);  // strides
  packet.append(reinterpret_cast<const char*>(rgb.data()), rgb.size() * sizeof(float));
  return WithLength(packet);
}

std::string WholePhoto(const std::string& name, const Raster& photo) {
  INSITU_CHECK(photo.channels == kChannels);
  return CreateImage(name, photo) +
         UpdateImage(name, {0, 0, photo.width, photo.height}, photo.data);
}

// Computed pixels, elsewhere the photograph's.
std::string ComputedTile(const std::string& name, const Raster& photo, const FinishedTile& tile) {
  const Tile place = TileAt(photo.width, photo.height, tile.index);
  std::vector<float> rgb;
  auto computed = tile.rgb.begin();
  auto is_computed = tile.is_computed.begin();
  for (int y = place.top; y < place.bottom; ++y) {
    for (int x = place.left; x < place.right; ++x) {
      if (*is_computed++ != 0) {
        rgb.insert(rgb.end(), computed, computed + kChannels);
        computed += kChannels;
      } else {
        rgb.insert(rgb.end(), photo.At(x, y), photo.At(x, y) + kChannels);
      }
    }
  }
  return UpdateImage(name, place, rgb);
}

// HOST and PORT as getaddrinfo takes them.
std::pair<std::string, std::string> Parted(const std::string& address) {
  const size_t colon = address.rfind(':');
  const std::string host = address.substr(0, colon);
  std::string port =
      colon == std::string::npos ? std::to_string(kTevPort) : address.substr(colon + 1);
  int number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  const bool is_port = error == std::errc() && end == port.data() + port.size() && number > 0 &&
                       number <= UINT16_MAX;
  if (host.empty() || !is_port) {
    throw InputError("--tev", "'" + address + "', expected HOST:PORT, as localhost:14158");
  }
  return {host, port};
}

// 0, or what is wrong, within kConnectMs.
int Connected(int socket, const addrinfo& place) {
  if (connect(socket, place.ai_addr, place.ai_addrlen) == 0) return 0;
  if (errno != EINPROGRESS) return errno;
  pollfd ready = {socket, POLLOUT, 0};
  if (poll(&ready, 1, kConnectMs) <= 0) return ETIMEDOUT;
  int error = 0;
  socklen_t size = sizeof(error);
  getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size);
  return error;
}

}  // namespace

StreamFormat TevFormat() {
  return {.begin = [] { return std::string(); },
          .image = WholePhoto,
          .tile = ComputedTile,
          .progress = [](int, int) { return std::string(); },
          .end = [](bool) { return std::string(); }};
}

TevConnection::TevConnection(const std::string& address) {
  const auto [host, port] = Parted(address);
  addrinfo hints = {};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int error = getaddrinfo(host.c_str(), port.c_str(), &hints, &found); error != 0) {
    throw InputError("--tev", "'" + address + "': " + gai_strerror(error));
  }
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> places(found, freeaddrinfo);
  int error = ECONNREFUSED;
  for (const addrinfo* place = found; place != nullptr; place = place->ai_next) {
    socket_ = ::socket(place->ai_family, place->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (socket_ < 0) continue;
    error = Connected(socket_, *place);
    if (error == 0) return;
    close(socket_);
  }
  throw InputError("--tev", "'" + address + "': " + std::strerror(error) +
                                "; start tev there first, which listens on port 14158");
}

TevConnection::~TevConnection() { close(socket_); }

}  // namespace insitu
