// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/web/live_window.h"

#include <json/reader.h>
#include <json/value.h>

#include <boost/asio/buffer.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>
#include <exception>

#include "calibration/web/request_guard.h"

namespace insitu {
namespace {

namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;

// "" if there is none.
std::string TokenIn(const std::string& message) {
  const std::unique_ptr<Json::CharReader> reader(Json::CharReaderBuilder().newCharReader());
  Json::Value value;
  const char* const begin = message.data();
  try {
    if (!reader->parse(begin, begin + message.size(), &value, nullptr) || !value.isObject()) {
      return "";
    }
  } catch (const Json::Exception&) {
    return "";  // nested too deeply
  }
  const Json::Value& token = value["token"];
  return token.isString() ? token.asString() : "";
}

// A window that is gone is noticed within `idle`, by pings if it has nothing to say.
websocket::stream_base::timeout Timeouts(std::chrono::milliseconds idle, bool pings) {
  return {std::chrono::seconds(10), idle, pings};
}

}  // namespace

LiveWindow::LiveWindow(ServerCore& core, std::unique_ptr<ConnectionPlace> place,
                       beast::tcp_stream stream)
    : core_(core), place_(std::move(place)), socket_(std::move(stream)) {
  beast::get_lowest_layer(socket_).expires_never();
  socket_.set_option(Timeouts(core.options.times.token, false));
  socket_.read_message_max(core.options.most_bytes);
  socket_.text(true);
  socket_.auto_fragment(false);
}

void LiveWindow::Accept(Upgrade upgrade) {
  upgrade_ = std::move(upgrade);
  socket_.async_accept(upgrade_, [self = shared_from_this()](beast::error_code error) {
    if (!error) self->Read();
  });
}

void LiveWindow::Read() {
  buffer_.clear();
  socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, size_t) {
    if (error) return self->Close();
    self->OnMessage(beast::buffers_to_string(self->buffer_.data()));
  });
}

void LiveWindow::OnMessage(std::string text) {
  if (window_ != 0) {
    return CallThenRead([this, text = std::move(text)] {
      if (core_.callbacks.on_message) core_.callbacks.on_message(window_, text);
    });
  }
  if (IsSameSecret(TokenIn(text), core_.options.token)) return Open();
  Refuse("the token is missing or another session's");
}

void LiveWindow::Open() {
  window_ = ++core_.last_window;
  core_.windows.emplace(window_, shared_from_this());
  socket_.set_option(Timeouts(core_.options.times.window, true));
  CallThenRead([this] {
    if (core_.callbacks.on_opened) core_.callbacks.on_opened(window_);
  });
}

template <typename Call>
void LiveWindow::CallThenRead(Call call) {
  WorkThen(
      core_, core_.threads, shared_from_this(),
      [call = std::move(call)]() -> std::string {
        try {
          call();
          return "";
        } catch (const std::exception& error) {
          return *error.what() ? error.what() : "exception";
        }
      },
      [this](const std::string& fault) {
        if (fault.empty()) return Read();
        Refuse(fault);
      });
}

// One write at a time; the others wait for it.
void LiveWindow::Send(std::shared_ptr<const std::string> text) {
  if (!queue_.empty() && queued_bytes_ + text->size() > core_.options.most_queued_bytes) {
    core_.windows.erase(window_);
    beast::get_lowest_layer(socket_).close();  // what reads, ends and says so
    return;
  }
  queued_bytes_ += text->size();
  queue_.push_back(std::move(text));
  if (queue_.size() == 1) Write();
}

void LiveWindow::Write() {
  socket_.async_write(boost::asio::buffer(*queue_.front()),
                      [self = shared_from_this()](beast::error_code error, size_t) {
                        if (error) return beast::get_lowest_layer(self->socket_).close();
                        self->queued_bytes_ -= self->queue_.front()->size();
                        self->queue_.pop_front();
                        if (!self->queue_.empty()) self->Write();
                      });
}

void LiveWindow::Refuse(const std::string& reason) {
  constexpr size_t kMostReason = 120;  // the protocol has room for 123 bytes
  socket_.async_close({websocket::close_code::policy_error, reason.substr(0, kMostReason)},
                      [self = shared_from_this()](beast::error_code) { self->Close(); });
}

void LiveWindow::Close() {
  core_.windows.erase(window_);
  beast::get_lowest_layer(socket_).close();
  if (window_ == 0 || !core_.callbacks.on_closed) return;
  WorkThen(
      core_, core_.threads, shared_from_this(),
      [this] {
        try {
          core_.callbacks.on_closed(window_);
        } catch (const std::exception&) {
          return false;  // there is no window left to close
        }
        return true;
      },
      [](bool) {});
}

}  // namespace insitu
