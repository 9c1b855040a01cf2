// What libsdformat makes of SDF files: the first one is a world, whose loose models are counted and weighed.
//
//     read_sdf WORLD.sdf [MODEL.sdf ...]
//
// Prints a line of JSON, or the errors of the first file that has any on the standard error output.

#include <cstdio>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <string>

#include <sdf/sdf.hh>

namespace {

std::string folder;

std::string Find(const std::string &uri) {
  const std::string name = uri.rfind("model://", 0) == 0 ? uri.substr(8) : uri;
  for (const std::string &start : {folder, folder + "/models"}) {
    const std::filesystem::path path = std::filesystem::path(start) / name;
    if (std::filesystem::exists(path)) return path.string();
  }
  return "";
}

bool Load(sdf::Root &root, const std::string &file) {
  folder = std::filesystem::path(file).parent_path().string();
  const sdf::Errors errors = root.Load(file);
  for (const sdf::Error &error : errors) std::cerr << file << ": " << error.Message() << "\n";
  return errors.empty();
}

int bodies = 0;
double mass = 0.0;

// A loose model and those in it, which hang from it.
void Count(const sdf::Model &model) {
  if (model.Static()) return;
  bodies += 1;
  for (uint64_t link = 0; link < model.LinkCount(); ++link)
    mass += model.LinkByIndex(link)->Inertial().MassMatrix().Mass();
  for (uint64_t inner = 0; inner < model.ModelCount(); ++inner) Count(*model.ModelByIndex(inner));
}

}  // namespace

int main(int count, char **files) {
  sdf::setFindCallback(Find);
  sdf::Root scene;
  if (count < 2 || !Load(scene, files[1])) return 1;
  for (int number = 2; number < count; ++number) {
    sdf::Root root;
    if (!Load(root, files[number])) return 1;
    if (root.Model() == nullptr) {
      std::cerr << files[number] << ": no model\n";
      return 1;
    }
  }
  const sdf::World *world = scene.WorldByIndex(0);
  if (world == nullptr) {
    std::cerr << files[1] << ": no world\n";
    return 1;
  }
  for (uint64_t number = 0; number < world->ModelCount(); ++number) Count(*world->ModelByIndex(number));
  std::cout << std::setprecision(17) << "{\"version\": \"" << SDF_VERSION_FULL << "\", \"bodies\": " << bodies
            << ", \"mass\": " << mass << "}\n";
  return 0;
}
