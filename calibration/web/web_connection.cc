// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/web/web_connection.h"

#include <boost/asio/buffer.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <cctype>
#include <chrono>

#include "calibration/files/error.h"
#include "calibration/web/live_window.h"

namespace insitu {
namespace {

namespace beast = boost::beast;
namespace http = boost::beast::http;

constexpr std::chrono::seconds kLinger(2);
constexpr size_t kMostHeadBytes = 16384;

std::string TextOf(beast::string_view text) { return {text.data(), text.size()}; }

std::vector<HeaderField> FieldsOf(const http::fields& fields) {
  std::vector<HeaderField> list;
  for (const auto& field : fields) {
    std::string name = TextOf(field.name_string());
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    list.push_back({std::move(name), TextOf(field.value())});
  }
  return list;
}

// What the page may load: its own, and pictures that it makes itself. Older browsers do not count
// ws: as the page's own.
std::string ContentPolicy(const std::string& host) {
  return "default-src 'self'; img-src 'self' blob: data:; connect-src 'self'" +
         (host.empty() ? "" : " ws://" + host) +
         "; frame-ancestors 'none'; base-uri 'none'; form-action 'none'";
}

void SetFields(const WebResponse& response, const std::string& host, http::fields* fields) {
  fields->set(http::field::content_type, response.type);
  fields->set(
      http::field::cache_control,
      response.max_age > 0 ? "private, max-age=" + std::to_string(response.max_age) : "no-store");
  fields->set("Content-Security-Policy", ContentPolicy(host));
  fields->set("X-Content-Type-Options", "nosniff");
  fields->set("Referrer-Policy", "no-referrer");
  fields->set("Cross-Origin-Resource-Policy", "same-origin");
  if (response.status == 401) fields->set(http::field::www_authenticate, "Bearer");
  if (response.status == 405) fields->set(http::field::allow, "GET, POST");
}

WebResponse AnswerOf(const LoopbackServerCallbacks& callbacks, const WebRequest& request) {
  try {
    return callbacks.on_request(request);
  } catch (const InputError& error) {
    return ErrorResponse(400, SentenceOf(error));
  } catch (const std::exception& error) {
    return ErrorResponse(500, SentenceOf(error));
  }
}

}  // namespace

WebConnection::WebConnection(ServerCore& core, boost::asio::ip::tcp::socket socket, bool is_beyond)
    : core_(core),
      place_(std::make_unique<ConnectionPlace>(is_beyond ? core.turned_away : core.served)),
      stream_(std::move(socket)),
      is_beyond_(is_beyond) {}

void WebConnection::ReadHead() {
  parser_.emplace();
  parser_->header_limit(kMostHeadBytes);
  parser_->body_limit(core_.options.most_bytes);
  host_.clear();
  stream_.expires_after(is_beyond_ ? kLinger : core_.options.times.idle);
  http::async_read_header(
      stream_, buffer_, *parser_,
      [self = shared_from_this()](beast::error_code error, size_t) { self->OnHead(error); });
}

// What is refused is refused before its body is read; the connection ends with it, if it has one.
void WebConnection::OnHead(beast::error_code error) {
  if (error) return AnswerFault(error);
  if (const auto refusal = HeadRefusal()) {
    closes_ = is_beyond_ || !parser_->is_done();
    return Answer(ErrorResponse(refusal->status, refusal->reason));
  }
  if (beast::websocket::is_upgrade(parser_->get()) && request_.path == core_.options.live_path) {
    return HandOver();
  }
  stream_.expires_after(core_.options.times.body);
  http::async_read(
      stream_, buffer_, *parser_,
      [self = shared_from_this()](beast::error_code fault, size_t) { self->OnBody(fault); });
}

std::optional<Refusal> WebConnection::HeadRefusal() {
  const auto& head = parser_->get();
  if (is_beyond_) return Refusal{503, "too many connections: close some windows of this page"};
  if (head.method() != http::verb::get && head.method() != http::verb::post) {
    return Refusal{405, "expected GET or POST"};
  }
  auto target = ParseTarget(TextOf(head.target()));
  if (!target) return Refusal{400, "expected a path of plain names"};
  request_ = std::move(*target);
  request_.method = TextOf(head.method_string());
  is_public_ =
      head.method() == http::verb::get && core_.options.public_resources.contains(request_.path);
  const bool is_live =
      beast::websocket::is_upgrade(head) && request_.path == core_.options.live_path;
  const RequestHead::Kind kind = is_public_ ? RequestHead::Kind::kPublic
                                 : is_live  ? RequestHead::Kind::kWebSocket
                                            : RequestHead::Kind::kToken;
  auto refusal = RefusalOf({kind, FieldsOf(head)}, core_.options.token);
  if (!refusal) host_ = TextOf(head[http::field::host]);
  return refusal;
}

void WebConnection::HandOver() {
  std::make_shared<LiveWindow>(core_, std::move(place_), std::move(stream_))
      ->Accept(parser_->release());
}

void WebConnection::OnBody(beast::error_code error) {
  if (error) return AnswerFault(error);
  closes_ = !parser_->get().keep_alive();
  if (is_public_) {
    const PublicResource& resource = core_.options.public_resources.at(request_.path);
    return Answer({200, resource.type, resource.text});
  }
  request_.body = std::move(parser_->get().body());
  stream_.expires_never();
  const bool is_slow = core_.options.slow_paths.contains(request_.path);
  WorkThen(
      core_, is_slow ? core_.slow_threads : core_.threads, shared_from_this(),
      [this] { return AnswerOf(core_.callbacks, request_); },
      [this](WebResponse response) { Answer(std::move(response)); });
}

// Silence, or an answer to what is no request of ours.
void WebConnection::AnswerFault(beast::error_code error) {
  closes_ = true;
  if (error == http::error::body_limit) {
    return Answer(ErrorResponse(
        413, "a body of over " + std::to_string(core_.options.most_bytes) + " bytes"));
  }
  if (error == http::error::header_limit) return Answer(ErrorResponse(431, "too long a head"));
  const bool is_http = error.category() == make_error_code(http::error::bad_method).category();
  if (is_http && error != http::error::end_of_stream && error != http::error::partial_message) {
    return Answer(ErrorResponse(400, "no HTTP request: " + error.message()));
  }
  stream_.close();
}

void WebConnection::Answer(WebResponse response) {
  response_ = {};
  response_.version(11);
  response_.result(static_cast<unsigned>(response.status));
  SetFields(response, host_, &response_.base());
  response_.body() = std::move(response.body);
  response_.keep_alive(!closes_);
  response_.prepare_payload();
  stream_.expires_after(core_.options.times.answer);
  http::async_write(
      stream_, response_,
      [self = shared_from_this()](beast::error_code error, size_t) { self->OnAnswered(error); });
}

void WebConnection::OnAnswered(beast::error_code error) {
  response_ = {};
  if (error) return stream_.close();
  if (!closes_) return ReadHead();
  stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, error);
  rest_.resize(65536);
  stream_.expires_after(kLinger);
  Linger();
}

// Closed with bytes unread, the connection would be reset and the answer lost on its way.
void WebConnection::Linger() {
  stream_.async_read_some(boost::asio::buffer(rest_),
                          [self = shared_from_this()](beast::error_code error, size_t) {
                            if (error) return self->stream_.close();
                            self->Linger();
                          });
}

}  // namespace insitu
