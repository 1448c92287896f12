// A JSON object of a protocol file with its place in it, read by key. A value that the schema refuses reads as the fallback.
// So the rules beyond the schema are checked in the same run, and all faults stand in one list.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "protocols/protocol_schema.h"

namespace protocols {

/// The faults of one file: those that the schema finds, and those found later.
class ProtocolFaults {
public:
    explicit ProtocolFaults(SchemaFaults ofSchema) : m_ofSchema(std::move(ofSchema.listed)), m_unlisted(ofSchema.unlisted) {}

    /// Adds "place: text", unless the schema has a fault at this place or around it: the new one then follows from that.
    void add(const std::string& fault);

    /// Whether the schema has a fault at this place.
    bool isRefused(const std::string& place) const;
    /// Whether the schema has a fault at this place or inside it.
    bool isRefusedWithin(const std::string& place) const;

    /// All of them, those of the schema first; of both kinds at most `mostFaults`.
    std::vector<SchemaFault> all() const;
    /// How many more there are.
    std::size_t unlisted() const { return m_unlisted; }

private:
    std::vector<SchemaFault> m_ofSchema;
    std::vector<SchemaFault> m_later;
    std::size_t m_unlisted;
};

class ProtocolPart {
public:
    /// `object` and `faults` must outlive it. An `object` that is none reads as an empty one.
    ProtocolPart(const nlohmann::json& object, std::string place, ProtocolFaults& faults);

    /// "phases[0].scale" for the key "scale" of the part "phases[0]".
    std::string placeOf(const std::string& key) const;
    ProtocolFaults& faults() const { return m_faults; }

    bool has(const std::string& key) const;
    /// The value as it stands; null where there is none.
    const nlohmann::json& raw(const std::string& key) const;

    std::string text(const std::string& key, const std::string& fallback) const;
    int whole(const std::string& key, int fallback) const;
    double number(const std::string& key, double fallback) const;
    bool yesOrNo(const std::string& key, bool fallback) const;
    /// The elements of a list; one that is no text is empty, so that the others keep their places.
    std::vector<std::string> texts(const std::string& key) const;

    ProtocolPart part(const std::string& key) const;
    /// The elements of a list of objects.
    std::vector<ProtocolPart> parts(const std::string& key) const;

private:
    const nlohmann::json& m_object;
    std::string m_place;
    ProtocolFaults& m_faults;
};

}  // namespace protocols
