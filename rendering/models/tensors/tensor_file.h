// Plain tensors in a file, in the layout of safetensors: numbers with names and shapes, no objects and no code.
//   8 bytes   N, the length of the header: unsigned, little-endian
//   N bytes   JSON {"__metadata__": {TEXT: TEXT, ...},
//                   NAME: {"dtype": "F16"|"F32"|"I64", "shape": [...], "data_offsets": [BEGIN, END]}, ...}
//   the rest  the numbers, little-endian, last index fastest; offsets count from the end of the header
// The layout is documented at https://github.com/huggingface/safetensors ("Format"). This reader has its own bounds: every
// number of the header is checked, and the tensors must be exactly those that the caller names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rendering::models {

/// Upper bound for the header; that of the shipped weights has 10 kB.
inline constexpr std::size_t largestTensorHeader = std::size_t{1} << 20;
/// So many bytes of a file hold its whole header.
inline constexpr std::size_t tensorHeaderRoom = 8 + largestTensorHeader;

enum class Element { F16, F32, I64 };

/// Name, kind of numbers and shape of a tensor. A shape without entries is a single number.
struct TensorKind {
    std::string name;
    Element element = Element::F32;
    std::vector<std::int64_t> shape;
    bool operator==(const TensorKind&) const = default;
};

struct StoredTensor {
    TensorKind kind;
    std::string bytes;  ///< the numbers, little-endian, last index fastest
    bool operator==(const StoredTensor&) const = default;
};

struct TensorFile {
    std::map<std::string, std::string> metadata;
    std::vector<StoredTensor> tensors;
    bool operator==(const TensorFile&) const = default;
};

/// What the errors of a reader say about its file.
struct TensorSource {
    std::filesystem::path file;
    std::string expected;  ///< "a weights file from `vis2hap train`"
    std::string nextStep;
};

/// Number of bytes of a tensor. Its shape must have no negative entries and no product beyond 64 bits.
std::uint64_t byteCount(const TensorKind& kind);

/// Bytes of a file: the tensors with the largest elements first, then in the order of their names. Every tensor must have the
/// bytes that its shape needs.
std::string tensorFileBytes(const TensorFile& file);

/// Reads a file of exactly the tensors `wanted`; the result has them in this order. Throws badInput where the bytes break the
/// layout, where names, kinds of numbers or shapes differ from the wanted ones, or where a number is not finite.
TensorFile parseTensorFile(std::string_view bytes, const std::vector<TensorKind>& wanted, const TensorSource& source);

/// The metadata of a file, of which `bytes` has at least the header. Throws badInput.
std::map<std::string, std::string> tensorMetadata(std::string_view bytes, const TensorSource& source);

/// Bytes of a regular file that is no larger than the wanted tensors and a header can be. Throws badInput.
std::string readTensorBytes(const std::vector<TensorKind>& wanted, const TensorSource& source);

/// Throws badInput for an archive of version 0.5.0 or before. Such a file holds objects and may hold code.
void refuseArchive(const TensorSource& source);

}  // namespace rendering::models
