// SPDX-License-Identifier: Apache-2.0
#include "linemodel/read_mesh.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>

namespace homeward::linemodel {
namespace {

/// A file system in which nothing is.
class NoFiles : public Assimp::IOSystem {
 public:
  bool Exists(const char*) const override { return false; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char*, const char*) override { return nullptr; }
  void Close(Assimp::IOStream*) override {}
};

class MeshTriangles {
 public:
  MeshTriangles(const aiScene& scene, double metres_per_unit, PlanUp up, const std::string& where)
      : scene_(scene), metres_per_unit_(metres_per_unit), up_(up), where_(where) {}

  Status add(const aiNode& node, const aiMatrix4x4& world_from_parent) {
    const aiMatrix4x4 world_from_node = world_from_parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (const Status added = add_mesh(*scene_.mMeshes[node.mMeshes[i]], world_from_node); !added) return added;
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      if (const Status added = add(*node.mChildren[i], world_from_node); !added) return added;
    }
    return {};
  }
  [[nodiscard]] std::size_t count() const { return builder_.triangles(); }
  Result<Plan> take() { return builder_.take(where_); }

 private:
  Status add_mesh(const aiMesh& mesh, const aiMatrix4x4& world_from_mesh) {
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      std::array<Eigen::Vector3d, 3> corners_m;
      for (unsigned k = 0; k < 3; ++k) {
        const aiVector3D p = world_from_mesh * mesh.mVertices[face.mIndices[k]];
        corners_m[k] = upright_m(metres_per_unit_ * Eigen::Vector3d(p.x, p.y, p.z), up_);
      }
      if (const Status added = builder_.add_triangle(corners_m, where_); !added) return added;
    }
    return {};
  }

  const aiScene& scene_;
  double metres_per_unit_;
  PlanUp up_;
  const std::string& where_;
  PlanBuilder builder_;
};

/// One line of printable letters.
std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c < 0x20 || c > 0x7e; }, ' ');
  return text;
}

}  // namespace

Result<Plan> read_mesh(std::string_view bytes, const std::string& extension, double metres_per_unit, PlanUp up,
                       const std::string& where) {
  Assimp::Importer importer;
  importer.SetIOHandler(new NoFiles);  // the importer's from now on
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(),
                                                     aiProcess_Triangulate | aiProcess_SortByPType, extension.c_str());
  if (scene == nullptr || scene->mRootNode == nullptr) {
    return fail(ErrorCode::kUnsupportedFormat, "The mesh cannot be read: " + one_line(importer.GetErrorString()),
                where);
  }
  MeshTriangles triangles(*scene, metres_per_unit, up, where);
  if (const Status added = triangles.add(*scene->mRootNode, aiMatrix4x4()); !added) return pass_on(added);
  if (triangles.count() == 0) return fail(ErrorCode::kEmptyInput, "The mesh has no triangle.", where);
  return triangles.take();
}

}  // namespace homeward::linemodel
