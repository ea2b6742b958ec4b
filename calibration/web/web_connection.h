// SPDX-License-Identifier: GPL-3.0-or-later
// One HTTP/1.1 connection of a loopback server, request after request.
#pragma once

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <memory>
#include <optional>
#include <string>

#include "calibration/web/request_guard.h"
#include "calibration/web/server_core.h"

namespace insitu {

class WebConnection : public std::enable_shared_from_this<WebConnection> {
 public:
  // `is_beyond`: one too many, which is told so.
  WebConnection(ServerCore& core, boost::asio::ip::tcp::socket socket, bool is_beyond);
  void ReadHead();

 private:
  using Parser = boost::beast::http::request_parser<boost::beast::http::string_body>;

  void OnHead(boost::beast::error_code error);
  void OnBody(boost::beast::error_code error);
  std::optional<Refusal> HeadRefusal();
  void HandOver();  // to a LiveWindow
  void Answer(WebResponse response);
  void AnswerFault(boost::beast::error_code error);
  void OnAnswered(boost::beast::error_code error);
  void Linger();

  ServerCore& core_;
  std::unique_ptr<ConnectionPlace> place_;
  boost::beast::tcp_stream stream_;
  const bool is_beyond_;
  boost::beast::flat_buffer buffer_;
  std::optional<Parser> parser_;
  std::string host_;  // of the request; "" until it is admitted
  WebRequest request_;
  bool is_public_ = false;
  bool closes_ = false;  // after this answer
  boost::beast::http::response<boost::beast::http::string_body> response_;
  std::string rest_;  // of what the other side sends after we closed
};

}  // namespace insitu
