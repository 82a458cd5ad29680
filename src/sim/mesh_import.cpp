// SPDX-License-Identifier: Apache-2.0
#include "sim/mesh_import.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "sim/triangles.hpp"

namespace homeward::sim {
namespace {

Image image_of(const cv::Mat& bgr) {
  cv::Mat rgb;
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  Image image(rgb.cols, rgb.rows, 3);
  for (int v = 0; v < rgb.rows; ++v) std::copy_n(rgb.ptr(v), static_cast<std::size_t>(rgb.cols) * 3, image.at(0, v));
  return image;
}

Image decode_texture(const aiTexture& texture) {
  if (texture.mHeight == 0) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(texture.pcData);
    const cv::Mat bgr = cv::imdecode(
        cv::Mat(1, static_cast<int>(texture.mWidth), CV_8UC1, const_cast<std::uint8_t*>(bytes)), cv::IMREAD_COLOR);
    return bgr.empty() ? Image(1, 1, 3) : image_of(bgr);
  }
  Image image(static_cast<int>(texture.mWidth), static_cast<int>(texture.mHeight), 3);
  for (std::size_t i = 0; i < image.data.size() / 3; ++i) {
    image.data[3 * i] = texture.pcData[i].r;
    image.data[3 * i + 1] = texture.pcData[i].g;
    image.data[3 * i + 2] = texture.pcData[i].b;
  }
  return image;
}

int texture_of(const aiScene& source, const aiMaterial& material) {
  for (const aiTextureType kind : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
    aiString path;
    if (material.GetTexture(kind, 0, &path) != aiReturn_SUCCESS) continue;
    for (unsigned i = 0; i < source.mNumTextures; ++i) {
      if (source.GetEmbeddedTexture(path.C_Str()) == source.mTextures[i]) return static_cast<int>(i);
    }
  }
  return -1;
}

std::vector<Material> materials_of(const aiScene& source) {
  std::vector<Material> materials;
  for (unsigned i = 0; i < source.mNumMaterials; ++i) {
    const aiMaterial& from = *source.mMaterials[i];
    Material material;
    material.name = from.GetName().C_Str();
    aiColor4D colour(0.8F, 0.8F, 0.8F, 1.0F);
    if (from.Get(AI_MATKEY_BASE_COLOR, colour) != aiReturn_SUCCESS) from.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
    material.base_colour = {colour.r, colour.g, colour.b};
    material.texture = texture_of(source, from);
    materials.push_back(material);
  }
  return materials;
}

class Collector {
 public:
  Collector(const aiScene& source, MeshUp up) : source_(source), up_(up) {}

  void visit(const aiNode& node, const aiMatrix4x4& parent) {
    const aiMatrix4x4 world_from_node = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add(*source_.mMeshes[node.mMeshes[i]], world_from_node);
    for (unsigned i = 0; i < node.mNumChildren; ++i) visit(*node.mChildren[i], world_from_node);
  }

  Scene take() { return triangles_.take(); }

 private:
  void add(const aiMesh& mesh, const aiMatrix4x4& world_from_mesh) {
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      std::array<Corner, 3> corners;
      for (unsigned k = 0; k < 3; ++k) {
        const unsigned index = face.mIndices[k];
        const aiVector3D p = world_from_mesh * mesh.mVertices[index];
        corners[k].position_m = up_ == MeshUp::kY ? Eigen::Vector3f(p.x, -p.z, p.y) : Eigen::Vector3f(p.x, p.y, p.z);
        const aiVector3D uv = mesh.HasTextureCoords(0) ? mesh.mTextureCoords[0][index] : aiVector3D();
        // assimp counts v upwards.
        corners[k].uv = {uv.x, 1.0F - uv.y};
      }
      triangles_.add(corners, static_cast<int>(mesh.mMaterialIndex));
    }
  }

  const aiScene& source_;
  MeshUp up_;
  LooseTriangles triangles_;
};

}  // namespace

Result<Scene> import_mesh(std::span<const std::uint8_t> bytes, const std::string& extension, MeshUp up,
                          const std::string& where) {
  Assimp::Importer importer;
  const aiScene* source = importer.ReadFileFromMemory(bytes.data(), bytes.size(),
                                                      aiProcess_Triangulate | aiProcess_SortByPType, extension.c_str());
  if (source == nullptr || source->mRootNode == nullptr) {
    return fail(ErrorCode::kUnsupportedFormat, std::string("The mesh cannot be read: ") + importer.GetErrorString(),
                where);
  }
  Collector collector(*source, up);
  collector.visit(*source->mRootNode, aiMatrix4x4());
  Scene scene = collector.take();
  if (scene.triangles.rows() == 0) return fail(ErrorCode::kEmptyInput, "The mesh has no triangle.", where);
  scene.materials = materials_of(*source);
  for (unsigned i = 0; i < source->mNumTextures; ++i) scene.textures.push_back(decode_texture(*source->mTextures[i]));
  return scene;
}

}  // namespace homeward::sim
