#include "rendering/models/tensors/tensor_file.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"

namespace rendering::models {

namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

constexpr std::size_t lengthBytes = 8, mostDimensions = 8;
constexpr const char* metadataName = "__metadata__";

struct ElementRow {
    Element element;
    const char* name;
    std::uint64_t bytes;
};
constexpr ElementRow elements[] = {{Element::I64, "I64", 8}, {Element::F32, "F32", 4}, {Element::F16, "F16", 2}};

const ElementRow& rowOf(Element element)
{
    return *std::ranges::find_if(elements, [element](const ElementRow& row) { return row.element == element; });
}

protocols::Error tensorFault(const TensorSource& source, const std::string& what)
{
    return protocols::badInput({what, source.file.string(), source.expected, source.nextStep});
}

/// nullopt where the product exceeds 64 bits.
std::optional<std::uint64_t> checkedByteCount(const TensorKind& kind)
{
    std::uint64_t bytes = rowOf(kind.element).bytes;
    for (const std::int64_t length : kind.shape)
        if (length < 0 || __builtin_mul_overflow(bytes, static_cast<std::uint64_t>(length), &bytes)) return std::nullopt;
    return bytes;
}

std::string textOf(const TensorKind& kind)
{
    std::string text = std::string(rowOf(kind.element).name) + " [";
    for (std::size_t i = 0; i < kind.shape.size(); ++i) text += (i == 0 ? "" : ", ") + std::to_string(kind.shape[i]);
    return text + "]";
}

/// A name as messages show it: only its printable ASCII characters, and not too many of them.
std::string shown(const std::string& name)
{
    constexpr std::size_t most = 80;
    std::string text;
    for (const char letter : name.substr(0, most)) text += letter >= ' ' && letter <= '~' ? letter : '?';
    return "'" + text + (name.size() > most ? "..." : "") + "'";
}

/// A tensor of the header and the place of its bytes behind the header.
struct PlacedTensor {
    TensorKind kind;
    std::uint64_t begin = 0, end = 0;
};

struct TensorHeader {
    std::map<std::string, std::string> metadata;
    std::vector<PlacedTensor> tensors;
};

std::uint64_t wholeNumber(const json& value, const std::string& meaning, const TensorSource& source)
{
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX))
        throw tensorFault(source, "the header has no whole number for " + meaning);
    return value.get<std::uint64_t>();
}

Element elementOf(const json& value, const std::string& name, const TensorSource& source)
{
    for (const ElementRow& row : elements)
        if (value == row.name) return row.element;
    throw tensorFault(source, "the tensor " + name + " has numbers of an unknown kind (known: F16, F32, I64)");
}

PlacedTensor placedTensor(const std::string& name, const json& value, const TensorSource& source)
{
    const std::string label = shown(name);
    for (const char* field : {"dtype", "shape", "data_offsets"})
        if (!value.is_object() || value.size() != 3 || !value.contains(field))
            throw tensorFault(source, "the header entry of the tensor " + label + " is not dtype, shape and data_offsets");
    const json &shape = value["shape"], &offsets = value["data_offsets"];
    if (!shape.is_array() || shape.size() > mostDimensions || !offsets.is_array() || offsets.size() != 2)
        throw tensorFault(source, "the shape or the offsets of the tensor " + label + " are not lists of the right length");
    PlacedTensor placed;
    placed.kind = {name, elementOf(value["dtype"], label, source), {}};
    for (const json& length : shape)
        placed.kind.shape.push_back(static_cast<std::int64_t>(wholeNumber(length, "the shape of " + label, source)));
    placed.begin = wholeNumber(offsets[0], "the offsets of " + label, source);
    placed.end = wholeNumber(offsets[1], "the offsets of " + label, source);
    const std::optional<std::uint64_t> needed = checkedByteCount(placed.kind);
    if (!needed || placed.end < placed.begin || placed.end - placed.begin != *needed)
        throw tensorFault(source, "the offsets of the tensor " + label + " do not fit its shape " + textOf(placed.kind));
    return placed;
}

TensorHeader parsedHeader(std::string_view text, const TensorSource& source)
{
    if (!text.starts_with('{')) throw tensorFault(source, "the header does not begin with {");
    const json root = [&] {
        try {
            return protocols::parseStrictJson(text, "header");
        } catch (const protocols::Error& fault) {
            throw tensorFault(source, std::string("the header is not usable JSON (") + fault.what() + ")");
        }
    }();
    TensorHeader header;
    for (const auto& [name, value] : root.items()) {
        if (name != metadataName) {
            header.tensors.push_back(placedTensor(name, value, source));
            continue;
        }
        if (!value.is_object()) throw tensorFault(source, "the metadata of the header are not an object of texts");
        for (const auto& [key, entry] : value.items()) {
            if (!entry.is_string()) throw tensorFault(source, "the metadata entry " + shown(key) + " is not a text");
            header.metadata[key] = entry.get<std::string>();
        }
    }
    return header;
}

/// The JSON of the header.
std::string_view headerText(std::string_view bytes, const TensorSource& source)
{
    std::uint64_t length = 0;
    if (bytes.size() < lengthBytes)
        throw tensorFault(source, "is too short for tensors: " + std::to_string(bytes.size()) + " bytes");
    std::memcpy(&length, bytes.data(), lengthBytes);
    if (length > largestTensorHeader || length > bytes.size() - lengthBytes)
        throw tensorFault(source, "has no header of plain tensors: it states a header of " + std::to_string(length) + " bytes");
    return bytes.substr(lengthBytes, length);
}

/// The tensors must follow one another without gaps and without shared bytes.
void requireWholeCover(std::vector<PlacedTensor> tensors, std::uint64_t dataBytes, const TensorSource& source)
{
    std::ranges::sort(tensors, {}, [](const PlacedTensor& tensor) { return std::pair(tensor.begin, tensor.end); });
    std::uint64_t end = 0;
    for (const PlacedTensor& tensor : tensors) {
        if (tensor.begin != end)
            throw tensorFault(source, "the tensor " + shown(tensor.kind.name) + " begins at byte " +
                                          std::to_string(tensor.begin) + " of the data, but the one before it ends at byte " +
                                          std::to_string(end));
        end = tensor.end;
    }
    if (end != dataBytes)
        throw tensorFault(source, "the header describes " + std::to_string(end) + " bytes of data, but the file has " +
                                      std::to_string(dataBytes));
}

template <class Bits>
bool allFinite(std::string_view bytes, Bits exponent)
{
    for (std::size_t at = 0; at + sizeof(Bits) <= bytes.size(); at += sizeof(Bits)) {
        Bits bits{};
        std::memcpy(&bits, bytes.data() + at, sizeof(Bits));
        if ((bits & exponent) == exponent) return false;
    }
    return true;
}

bool numbersFinite(const StoredTensor& tensor)
{
    switch (tensor.kind.element) {
        case Element::F16:
            return allFinite<std::uint16_t>(tensor.bytes, 0x7C00U);
        case Element::F32:
            return allFinite<std::uint32_t>(tensor.bytes, 0x7F800000U);
        case Element::I64:
            return true;
    }
    return false;
}

StoredTensor takenFrom(const std::map<std::string, const PlacedTensor*>& byName, const TensorKind& wanted, std::string_view data,
                       const TensorSource& source)
{
    const auto found = byName.find(wanted.name);
    if (found == byName.end()) throw tensorFault(source, "the tensor " + shown(wanted.name) + " is missing");
    const PlacedTensor& placed = *found->second;
    if (placed.kind != wanted)
        throw tensorFault(source, "the tensor " + shown(wanted.name) + " is " + textOf(placed.kind) + " (expected " +
                                      textOf(wanted) + ", as the networks need)");
    StoredTensor tensor{wanted, std::string(data.substr(placed.begin, placed.end - placed.begin))};
    if (!numbersFinite(tensor))
        throw tensorFault(source, "the tensor " + shown(wanted.name) + " holds numbers that are not finite");
    return tensor;
}

}  // namespace

std::uint64_t byteCount(const TensorKind& kind)
{
    const std::optional<std::uint64_t> bytes = checkedByteCount(kind);
    assert(bytes && "shapes of our own tensors are small");
    return *bytes;
}

std::string tensorFileBytes(const TensorFile& file)
{
    std::vector<const StoredTensor*> order;
    for (const StoredTensor& tensor : file.tensors) order.push_back(&tensor);
    std::ranges::sort(order, [](const StoredTensor* a, const StoredTensor* b) {
        const std::uint64_t sizeA = rowOf(a->kind.element).bytes, sizeB = rowOf(b->kind.element).bytes;
        return sizeA != sizeB ? sizeA > sizeB : a->kind.name < b->kind.name;
    });
    nlohmann::ordered_json header = nlohmann::ordered_json::object();
    if (!file.metadata.empty()) header[metadataName] = file.metadata;
    std::string data;
    for (const StoredTensor* tensor : order) {
        assert(tensor->bytes.size() == byteCount(tensor->kind) && "a tensor has the bytes of its shape");
        const std::size_t begin = data.size();
        data += tensor->bytes;
        header[tensor->kind.name] = {
            {"dtype", rowOf(tensor->kind.element).name}, {"shape", tensor->kind.shape}, {"data_offsets", {begin, data.size()}}};
    }
    std::string text = header.dump();
    text.append((lengthBytes - text.size() % lengthBytes) % lengthBytes, ' ');  // So that the data are aligned.
    const std::uint64_t length = text.size();
    std::string bytes(lengthBytes, '\0');
    std::memcpy(bytes.data(), &length, lengthBytes);
    return bytes + text + data;
}

TensorFile parseTensorFile(std::string_view bytes, const std::vector<TensorKind>& wanted, const TensorSource& source)
{
    const std::string_view text = headerText(bytes, source);
    const TensorHeader header = parsedHeader(text, source);
    const std::string_view data = bytes.substr(lengthBytes + text.size());
    requireWholeCover(header.tensors, data.size(), source);
    std::map<std::string, const PlacedTensor*> byName;
    for (const PlacedTensor& tensor : header.tensors) byName[tensor.kind.name] = &tensor;
    TensorFile file{header.metadata, {}};
    for (const TensorKind& kind : wanted) {
        file.tensors.push_back(takenFrom(byName, kind, data, source));
        byName.erase(kind.name);
    }
    if (!byName.empty())
        throw tensorFault(source, "the tensor " + shown(byName.begin()->first) + " does not belong to the networks");
    return file;
}

std::map<std::string, std::string> tensorMetadata(std::string_view bytes, const TensorSource& source)
{
    return parsedHeader(headerText(bytes, source), source).metadata;
}

std::string readTensorBytes(const std::vector<TensorKind>& wanted, const TensorSource& source)
{
    refuseArchive(source);
    std::uint64_t most = tensorHeaderRoom;
    for (const TensorKind& kind : wanted) most += byteCount(kind);
    return protocols::readRegularFile(source.file, most);
}

void refuseArchive(const TensorSource& source)
{
    if (protocols::beginningOf(source.file, 4) != std::string_view("PK\x03\x04", 4)) return;
    throw protocols::badInput({"is an archive of objects, which can hold code (a .pt file of version 0.5.0 or before)",
                               source.file.string(), source.expected + ", which holds plain tensors only (safetensors)",
                               source.nextStep});
}

}  // namespace rendering::models
