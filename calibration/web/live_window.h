// SPDX-License-Identifier: GPL-3.0-or-later
// The WebSocket of one window: its token first, then messages both ways.
#pragma once

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <deque>
#include <memory>
#include <string>

#include "calibration/web/server_core.h"

namespace insitu {

class LiveWindow : public std::enable_shared_from_this<LiveWindow> {
 public:
  using Upgrade = boost::beast::http::request<boost::beast::http::string_body>;

  LiveWindow(ServerCore& core, std::unique_ptr<ConnectionPlace> place,
             boost::beast::tcp_stream stream);
  void Accept(Upgrade upgrade);
  void Send(std::shared_ptr<const std::string> text);

 private:
  void Read();
  void OnMessage(std::string text);
  void Open();
  void Write();
  void Refuse(const std::string& reason);
  void Close();  // of itself or by the other side: says so, once
  // Calls a callback on a thread of the server, then reads on; closes if it throws.
  template <typename Call>
  void CallThenRead(Call call);

  ServerCore& core_;
  const std::unique_ptr<ConnectionPlace> place_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  Upgrade upgrade_;
  boost::beast::flat_buffer buffer_;
  int window_ = 0;  // 0: its token has not come
  std::deque<std::shared_ptr<const std::string>> queue_;
  size_t queued_bytes_ = 0;
};

}  // namespace insitu
