// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/view/page_server.h"

#include <atomic>
#include <thread>
#include <utility>

#include "calibration/web/end_signals.h"
#include "calibration/web/loopback_server.h"
#include "calibration/web/open_browser.h"
#include "calibration/web/request_guard.h"
#include "reconstruction/editing/edited_tables.h"
#include "renderer/view/view_page.h"

namespace insitu {
namespace {

LoopbackServerOptions ServerOptionsOf(const ViewOptions& options, const std::string& token) {
  LoopbackServerOptions server;
  server.port = options.port;
  server.token = token;
  server.public_resources = ViewPage();
  server.slow_paths = {"/api/tile", "/api/value", "/api/outline", "/api/difference"};
  return server;
}

}  // namespace

WebResponse JsonAnswer(const Json::Value& json) {
  WebResponse response;
  response.body = OneLineJson(json);
  return response;
}

void ServePage(
    const ViewOptions& options,
    const std::function<std::unique_ptr<PageService>(std::function<void(std::string)> send)>& make,
    const std::function<void(const std::string& url)>& tell) {
  const EndSignals end;
  const std::string token = NewToken();
  std::atomic<LoopbackServer*> windows = nullptr;
  const std::unique_ptr<PageService> service = make([&windows](std::string text) {
    if (LoopbackServer* server = windows) server->Send(std::move(text));
  });
  LoopbackServer server(ServerOptionsOf(options, token),
                        {.on_request = [&](const WebRequest& r) { return service->Answer(r); }});
  windows = &server;  // what was told before that, the page asks for when it comes
  const std::string url = server.address() + "#" + token;
  std::jthread serving([&] { server.Run(); });
  tell(url);
  {
    const auto page = options.opens_browser ? std::make_unique<OpenedPage>(url) : nullptr;
    end.Wait();
  }
  server.Stop();
  serving.join();
  service->Stop();
}

}  // namespace insitu
