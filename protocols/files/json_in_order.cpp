#include "protocols/files/json_in_order.h"

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace protocols {

namespace {

/// Leaves each key once, with its last value in the place of the first one, as the library's reader does.
void keepLastValues(nlohmann::ordered_json::object_t& members)
{
    const auto member = members.begin();
    std::vector<std::size_t> first(members.size());   // the place of the first member with this key
    std::map<std::string_view, std::size_t> placeOf;  // not hashed: a text could be made of keys with one hash
    for (std::size_t i = 0; i < first.size(); ++i)
        first[i] = placeOf.emplace(member[static_cast<std::ptrdiff_t>(i)].first, i).first->second;
    if (placeOf.size() == first.size()) return;
    nlohmann::ordered_json::object_t single;
    std::vector<std::size_t> placeInSingle(first.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        auto& [key, value] = member[static_cast<std::ptrdiff_t>(i)];
        if (first[i] == i) {
            placeInSingle[i] = single.size();
            single.emplace_back(key, std::move(value));
        } else
            single.begin()[static_cast<std::ptrdiff_t>(placeInSingle[first[i]])].second = std::move(value);
    }
    members.swap(single);
}

/// Takes the values of a text one after the other.
class ReaderInOrder final : public nlohmann::ordered_json::json_sax_t {
public:
    using Json = nlohmann::ordered_json;

    enum class Source {
        Given,   ///< faults are thrown, and doubled keys stay for the check that names them
        Stored,  ///< a fault ends the reading, and of a doubled key the last value counts
    };

    explicit ReaderInOrder(Source source) : m_source(source) {}

    Json takeRoot() { return std::move(m_root); }

    bool null() override { return put(nullptr); }
    bool boolean(bool value) override { return put(value); }
    bool number_integer(number_integer_t value) override { return put(value); }
    bool number_unsigned(number_unsigned_t value) override { return put(value); }
    bool number_float(number_float_t value, const string_t&) override { return put(value); }
    bool string(string_t& value) override { return put(std::move(value)); }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override
    {
        m_key = std::move(name);
        return true;
    }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& fault) override
    {
        if (m_source == Source::Stored) return false;
        if (const auto* malformed = dynamic_cast<const Json::parse_error*>(&fault)) throw Json::parse_error(*malformed);
        if (const auto* tooLarge = dynamic_cast<const Json::out_of_range*>(&fault)) throw Json::out_of_range(*tooLarge);
        throw fault;
    }

private:
    bool put(Json value)
    {
        place(std::move(value));
        return true;
    }

    /// Where the value stands from now on.
    Json* place(Json value)
    {
        if (m_open.empty()) return &(m_root = std::move(value));
        if (m_open.back()->is_array()) return &m_open.back()->get_ref<Json::array_t&>().emplace_back(std::move(value));
        return &m_open.back()->get_ref<Json::object_t&>().emplace_back(std::move(m_key), std::move(value)).second;
    }

    bool open(Json empty)
    {
        m_open.push_back(place(std::move(empty)));
        return true;
    }

    bool close()
    {
        if (m_source == Source::Stored && m_open.back()->is_object()) keepLastValues(m_open.back()->get_ref<Json::object_t&>());
        m_open.pop_back();
        return true;
    }

    Source m_source;
    Json m_root;
    std::string m_key;          // of the next member
    std::vector<Json*> m_open;  // none of them moves: only the innermost one grows
};

}  // namespace

nlohmann::ordered_json jsonInOrder(std::string_view text)
{
    ReaderInOrder reader(ReaderInOrder::Source::Given);
    nlohmann::ordered_json::sax_parse(text.begin(), text.end(), &reader);
    return reader.takeRoot();
}

nlohmann::ordered_json storedJsonInOrder(std::string_view text)
{
    using Json = nlohmann::ordered_json;
    ReaderInOrder reader(ReaderInOrder::Source::Stored);
    const bool isRead = Json::sax_parse(text.begin(), text.end(), &reader);
    return isRead ? reader.takeRoot() : Json(Json::value_t::discarded);
}

}  // namespace protocols
