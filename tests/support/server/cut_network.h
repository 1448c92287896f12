// A way to a server that can be cut: a relay on a port of its own, on a thread of its own.
#pragma once

#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

namespace tests::support {

class CutNetwork {
public:
    explicit CutNetwork(int serverPort);
    ~CutNetwork();
    CutNetwork(const CutNetwork&) = delete;
    CutNetwork& operator=(const CutNetwork&) = delete;

    int port() const { return m_port; }
    /// Ends all connections and takes no new ones.
    void cut() { m_state = State::Cut; }
    /// Carries nothing and ends nothing, as a pulled plug does.
    void silence() { m_state = State::Silent; }
    void mend() { m_state = State::Open; }
    /// From here on new clients are told other process numbers than the server's, as a pooler does.
    void pool() { m_isPooler = true; }

private:
    enum class State { Open, Cut, Silent, Ended };
    struct Pair {
        int client = -1, server = -1;
    };
    void run();
    void closeAll();
    bool carry(int from, int to) const;

    int m_listener = -1, m_port = 0, m_serverPort;
    std::atomic<State> m_state = State::Open;
    std::atomic<bool> m_isPooler = false;
    std::vector<Pair> m_pairs;
    std::thread m_thread;
};

}  // namespace tests::support
