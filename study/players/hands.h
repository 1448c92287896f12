// What a scripted or simulated participant acts through: the session driver itself, or the window's
// widgets. Both take the same events and show the same state.
#pragma once

#include <optional>

#include "study/session/driver.h"

namespace study::players {

class Hands {
public:
    virtual ~Hands() = default;
    virtual std::optional<session::Refusal> perform(const session::EventBody& event) = 0;
    virtual const session::State& state() const = 0;
};

class DriverHands final : public Hands {
public:
    explicit DriverHands(session::Driver& driver) : m_driver(driver) {}
    std::optional<session::Refusal> perform(const session::EventBody& event) override { return m_driver.send(event); }
    const session::State& state() const override { return m_driver.state(); }

private:
    session::Driver& m_driver;
};

}  // namespace study::players
