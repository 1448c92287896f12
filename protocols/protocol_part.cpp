#include "protocols/protocol_part.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace protocols {

namespace {

using nlohmann::json;

/// "phases[0]" is around "phases[0].scale", and around itself.
bool isAround(const std::string& outer, const std::string& inner)
{
    if (!inner.starts_with(outer)) return false;
    return inner.size() == outer.size() || inner[outer.size()] == '.' || inner[outer.size()] == '[';
}

const json& nothing()
{
    static const json null;
    return null;
}

const json& emptyObject()
{
    static const json object = json::object();
    return object;
}

}  // namespace

void ProtocolFaults::add(const std::string& fault)
{
    const std::string place = fault.substr(0, fault.find(": "));
    const bool isConsequence =
        std::ranges::any_of(m_ofSchema, [&](const SchemaFault& known) { return isAround(known.place, place); });
    if (isConsequence) return;
    if (m_later.size() < mostFaults)
        m_later.push_back({place, fault});
    else
        ++m_unlisted;
}

bool ProtocolFaults::isRefused(const std::string& place) const
{
    return std::ranges::any_of(m_ofSchema, [&](const SchemaFault& fault) { return fault.place == place; });
}

bool ProtocolFaults::isRefusedWithin(const std::string& place) const
{
    return std::ranges::any_of(m_ofSchema, [&](const SchemaFault& fault) { return isAround(place, fault.place); });
}

std::vector<SchemaFault> ProtocolFaults::all() const
{
    std::vector<SchemaFault> faults = m_ofSchema;
    faults.insert(faults.end(), m_later.begin(), m_later.end());
    return faults;
}

ProtocolPart::ProtocolPart(const json& object, std::string place, ProtocolFaults& faults)
    : m_object(object.is_object() ? object : emptyObject()), m_place(std::move(place)), m_faults(faults)
{
}

std::string ProtocolPart::placeOf(const std::string& key) const { return m_place.empty() ? key : m_place + "." + key; }

bool ProtocolPart::has(const std::string& key) const { return m_object.contains(key); }

const json& ProtocolPart::raw(const std::string& key) const
{
    const auto found = m_object.find(key);
    return found == m_object.end() ? nothing() : *found;
}

std::string ProtocolPart::text(const std::string& key, const std::string& fallback) const
{
    return raw(key).is_string() ? raw(key).get<std::string>() : fallback;
}

int ProtocolPart::whole(const std::string& key, int fallback) const
{
    // The schema bounds every whole number, so one that it takes fits an int.
    return raw(key).is_number() && !m_faults.isRefused(placeOf(key)) ? raw(key).get<int>() : fallback;
}

double ProtocolPart::number(const std::string& key, double fallback) const
{
    return raw(key).is_number() && !m_faults.isRefused(placeOf(key)) ? raw(key).get<double>() : fallback;
}

bool ProtocolPart::yesOrNo(const std::string& key, bool fallback) const
{
    return raw(key).is_boolean() ? raw(key).get<bool>() : fallback;
}

std::vector<std::string> ProtocolPart::texts(const std::string& key) const
{
    std::vector<std::string> texts;
    if (!raw(key).is_array()) return texts;
    for (const json& element : raw(key)) texts.push_back(element.is_string() ? element.get<std::string>() : "");
    return texts;
}

ProtocolPart ProtocolPart::part(const std::string& key) const { return {raw(key), placeOf(key), m_faults}; }

std::vector<ProtocolPart> ProtocolPart::parts(const std::string& key) const
{
    std::vector<ProtocolPart> parts;
    if (!raw(key).is_array()) return parts;
    for (std::size_t i = 0; i < raw(key).size(); ++i)
        parts.emplace_back(raw(key)[i], placeOf(key) + "[" + std::to_string(i) + "]", m_faults);
    return parts;
}

}  // namespace protocols
