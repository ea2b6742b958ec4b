// SPDX-License-Identifier: GPL-3.0-or-later
// reconstruction_figures DATA [FIGURE...]: measures and prints them as JSON. DATA is the folder
// data of shared/; figures whose data is not there are named on stderr and left out.
#include <json/json.h>

#include <iostream>
#include <set>

#include "tests/benchmarks/reconstruction_figures.h"

namespace {

int Run(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "reconstruction_figures DATA [FIGURE...]\n";
    return 2;
  }
  const std::filesystem::path data = argv[1];
  const std::set<std::string> chosen(argv + 2, argv + argc);
  Json::Value json(Json::objectValue);
  for (const insitu::ReconstructionFigure& figure : insitu::ReconstructionFigures()) {
    if (!chosen.empty() && !chosen.contains(figure.key)) continue;
    if (!figure.folder.empty() && !std::filesystem::exists(data / figure.folder)) {
      std::cerr << "SKIPPED " << figure.key << ": no " << (data / figure.folder).string() << '\n';
      continue;
    }
    json[figure.key] = figure.measure(data);
  }
  std::cout << json << '\n';
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return Run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
