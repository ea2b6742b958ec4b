// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/web/loopback_server.h"

#include <signal.h>
#include <sys/socket.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cerrno>
#include <chrono>

#include "calibration/files/error.h"
#include "calibration/web/live_window.h"
#include "calibration/web/server_core.h"
#include "calibration/web/web_connection.h"

namespace insitu {
namespace {

using boost::asio::ip::tcp;

// Children of this process, as its runs of stages, must not hold the port.
tcp::acceptor BoundAcceptor(boost::asio::io_context& network, int port) {
  const int descriptor = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) throw std::runtime_error("no socket can be made");
  tcp::acceptor acceptor(network, tcp::v4(), descriptor);
  acceptor.set_option(tcp::acceptor::reuse_address(true));
  boost::system::error_code error;
  acceptor.bind({boost::asio::ip::address_v4::loopback(), static_cast<uint16_t>(port)}, error);
  if (!error) acceptor.listen(boost::asio::socket_base::max_listen_connections, error);
  if (error) {
    throw InputError("port " + std::to_string(port),
                     "cannot be served on (" + error.message() + "), expected a free one");
  }
  acceptor.non_blocking(true);
  return acceptor;
}

}  // namespace

struct LoopbackServer::Parts {
  Parts(LoopbackServerOptions options, LoopbackServerCallbacks callbacks)
      : core(std::move(options), std::move(callbacks)),
        acceptor(BoundAcceptor(core.network, core.options.port)),
        pause(core.network) {}

  void WaitForConnection() {
    acceptor.async_wait(tcp::acceptor::wait_read, [this](boost::system::error_code error) {
      if (!error) Accept();
    });
  }

  void Accept() {
    const int descriptor =
        accept4(acceptor.native_handle(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (descriptor >= 0) Serve(descriptor);
    const bool is_exhausted = descriptor < 0 && (errno == EMFILE || errno == ENFILE ||
                                                 errno == ENOBUFS || errno == ENOMEM);
    if (!is_exhausted) return WaitForConnection();
    pause.expires_after(std::chrono::milliseconds(200));
    pause.async_wait([this](boost::system::error_code) { WaitForConnection(); });
  }

  // As many more as are served are told that they are too many.
  void Serve(int descriptor) {
    tcp::socket socket(core.network, tcp::v4(), descriptor);
    const size_t most = core.options.most_connections;
    const bool is_beyond = core.served >= most;
    if (is_beyond && core.turned_away >= most) return;
    boost::system::error_code error;
    socket.set_option(tcp::no_delay(true), error);
    std::make_shared<WebConnection>(core, std::move(socket), is_beyond)->ReadHead();
  }

  ServerCore core;
  tcp::acceptor acceptor;
  boost::asio::steady_timer pause;
};

LoopbackServer::LoopbackServer(LoopbackServerOptions options, LoopbackServerCallbacks callbacks) {
  options.Check();
  INSITU_CHECK(callbacks.on_request);
  signal(SIGPIPE, SIG_IGN);
  parts_ = std::make_unique<Parts>(std::move(options), std::move(callbacks));
}

LoopbackServer::~LoopbackServer() = default;

int LoopbackServer::port() const { return parts_->acceptor.local_endpoint().port(); }

std::string LoopbackServer::address() const {
  return "http://127.0.0.1:" + std::to_string(port()) + "/";
}

void LoopbackServer::Run() {
  ServerCore& core = parts_->core;
  parts_->WaitForConnection();
  core.network.run();
  for (auto* const threads : {&core.threads, &core.slow_threads}) {
    threads->stop();
    threads->join();
  }
}

void LoopbackServer::Stop() { parts_->core.network.stop(); }

void LoopbackServer::Send(std::string text) {
  ServerCore& core = parts_->core;
  boost::asio::post(core.network,
                    [&core, shared = std::make_shared<const std::string>(std::move(text))] {
                      const auto windows = core.windows;  // a window that is closed leaves them
                      for (const auto& [number, window] : windows) window->Send(shared);
                    });
}

void LoopbackServer::SendTo(int window, std::string text) {
  ServerCore& core = parts_->core;
  boost::asio::post(core.network,
                    [&core, window, shared = std::make_shared<const std::string>(std::move(text))] {
                      const auto found = core.windows.find(window);
                      if (found == core.windows.end()) return;
                      const std::shared_ptr<LiveWindow> target = found->second;
                      target->Send(shared);
                    });
}

}  // namespace insitu
