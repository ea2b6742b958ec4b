// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/tiles/tev_stream.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <string>
#include <thread>

#include "calibration/files/error.h"

namespace insitu {
namespace {

using testing::HasSubstr;

// Reads packets as tev's Ipc.cpp does, written from its description.
class Packets {
 public:
  explicit Packets(std::string bytes) : bytes_(std::move(bytes)) {}
  bool AtEnd() const { return at_ == bytes_.size(); }
  template <typename Number>
  Number Get() {
    Number number = 0;
    EXPECT_LE(at_ + sizeof(number), bytes_.size());
    std::memcpy(&number, bytes_.data() + at_, sizeof(number));
    at_ += sizeof(number);
    return number;
  }
  std::string Text() {
    const std::string text = bytes_.c_str() + at_;
    at_ += text.size() + 1;
    return text;
  }
  size_t at() const { return at_; }

 private:
  std::string bytes_;
  size_t at_ = 0;
};

// The picture that a viewer holds after the packets.
struct Viewed {
  std::string name;
  Raster picture;
  int updates = 0;

  void Take(Packets* packets) {
    const size_t begin = packets->at();
    const auto length = packets->Get<uint32_t>();
    const int kind = packets->Get<uint8_t>();
    const bool takes_focus = packets->Get<uint8_t>() != 0;
    const std::string of = packets->Text();
    if (kind == 4) {
      name = of;
      EXPECT_TRUE(takes_focus);
      const auto width = packets->Get<int32_t>(), height = packets->Get<int32_t>();
      picture = Raster(width, height);
      TakeChannels(packets);
    } else {
      EXPECT_EQ(kind, 6);
      EXPECT_EQ(of, name);
      Update(packets);
    }
    EXPECT_EQ(packets->at(), begin + length);
  }

  void Update(Packets* packets) {
    ++updates;
    TakeChannels(packets);
    std::array<int32_t, 4> place;  // x, y, width, height
    for (int32_t& side : place) side = packets->Get<int32_t>();
    for (int c = 0; c < 3; ++c) EXPECT_EQ(packets->Get<int64_t>(), c);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(packets->Get<int64_t>(), 3);
    for (int y = 0; y < place[3]; ++y) {
      for (int x = 0; x < place[2]; ++x) {
        for (int c = 0; c < 3; ++c) {
          picture.At(place[0] + x, place[1] + y)[c] = packets->Get<float>();
        }
      }
    }
  }

  static void TakeChannels(Packets* packets) {
    EXPECT_EQ(packets->Get<int32_t>(), 3);
    for (const char* channel : {"R", "G", "B"}) EXPECT_EQ(packets->Text(), channel);
  }
};

// 40 x 33 px: tiles of four sizes.
Raster Photo() {
  Raster photo(40, 33);
  for (size_t i = 0; i < photo.data.size(); ++i) photo.data[i] = static_cast<float>(i) / 100;
  return photo;
}

// Every second pixel of a tile computed: to -1 and 2, which have no code.
FinishedTile HalfTile(const Raster& photo, int index) {
  FinishedTile tile;
  tile.index = index;
  const int pixels = TileAt(photo.width, photo.height, index).pixels();
  for (int i = 0; i < pixels; ++i) {
    tile.is_computed.push_back(static_cast<uint8_t>(i % 2));
    if (i % 2 == 1) tile.rgb.insert(tile.rgb.end(), {-1, 0.5F, 2});
  }
  return tile;
}

TEST(TevFormat, AViewerHoldsThePictureInTheEnd) {
  const Raster photo = Photo();
  const StreamFormat format = TevFormat();
  std::string bytes = format.begin() + format.image("left", photo);
  Raster expected = photo;
  for (int index = 0; index < TileCount(40, 33); ++index) {
    bytes += format.tile("left", photo, HalfTile(photo, index)) + format.progress(index, 4);
    const Tile place = TileAt(40, 33, index);
    int i = 0;
    for (int y = place.top; y < place.bottom; ++y) {
      for (int x = place.left; x < place.right; ++x) {
        if (i++ % 2 == 1) expected.SetRgb(x, y, {-1, 0.5, 2});
      }
    }
  }
  Packets packets(bytes + format.end(true));
  Viewed viewed;
  while (!packets.AtEnd() && !testing::Test::HasFailure()) viewed.Take(&packets);
  EXPECT_EQ(viewed.name, "left");
  EXPECT_EQ(viewed.updates, 5);
  EXPECT_EQ(viewed.picture.data, expected.data);
}

// A listener on a port of the loopback that is free.
class Listener {
 public:
  Listener() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in place = {};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(place);
    EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&place), size), 0);
    EXPECT_EQ(listen(socket_, 1), 0);
    EXPECT_EQ(getsockname(socket_, reinterpret_cast<sockaddr*>(&place), &size), 0);
    port_ = ntohs(place.sin_port);
  }
  ~Listener() { close(socket_); }
  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
  std::string ReadAll() const {
    const int accepted = accept(socket_, nullptr, nullptr);
    std::string bytes;
    std::array<char, 4096> part;
    for (ssize_t count = 1; count > 0;) {
      count = read(accepted, part.data(), part.size());
      if (count > 0) bytes.append(part.data(), static_cast<size_t>(count));
    }
    close(accepted);
    return bytes;
  }

 private:
  int socket_;
  int port_ = 0;
};

TEST(TevConnection, ARenderArrivesThroughASocket) {
  const Listener listener;
  const Raster photo = Photo();
  std::string bytes;
  std::thread viewer([&] { bytes = listener.ReadAll(); });
  {
    const TevConnection tev(listener.address());
    RenderStream stream(tev.socket(), TevFormat());
    stream.Begin("left", photo);
    for (int index = 0; index < 4; ++index) stream.Take(HalfTile(photo, index));
    stream.End(true);
  }
  viewer.join();
  Packets packets(bytes);
  Viewed viewed;
  while (!packets.AtEnd() && !testing::Test::HasFailure()) viewed.Take(&packets);
  EXPECT_EQ(viewed.updates, 5);
  EXPECT_EQ(viewed.picture.At(1, 0)[2], 2);
}

std::string Refusal(const std::string& address) {
  try {
    const TevConnection tev(address);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TevConnection, IsRefusedByAWord) {
  std::string address;
  {
    const Listener closed;
    address = closed.address();
  }
  EXPECT_THAT(Refusal(address), HasSubstr("Connection refused; start tev there first"));
  for (const char* text : {"localhost:", ":14158", "localhost:70000", "localhost:tev", ""}) {
    EXPECT_THAT(Refusal(text), HasSubstr("expected HOST:PORT")) << text;
  }
}

}  // namespace
}  // namespace insitu
