-- What a station, a monitor and an analyst may do in a study. Every function that a login may call runs with the rights of the
-- study's owner; roles.sql says who may call which. Functions whose names begin with server_ are for these functions and the
-- owner only.
--
-- Rules for callers:
--   * claim(), presentation() and presented_image() are refused in a transaction that has written before. Otherwise a login could
--     store made-up answers, read ahead, and roll back without a trace. Call each function as a statement of its own, outside a
--     transaction.
--   * Arguments are passed by place. presentation() calls its argument number and familiarisation_image() calls it item, because
--     a result column has the name trial, and position is a word of SQL.
--   * A connection is known by its process number and by an advisory lock under a random number that join_study() draws. The
--     owner could not use the start time of a connection: a server shows it to its own login and to pg_read_all_stats only.
--     A connection that releases its advisory locks must join again.
--   * join_study(), claim(), store(), record_act() and record_latency() return a refusal as a value, {"refused": {"code": ...,
--     "message": ..., "detail": ..., "hint": ...}}. An error would put the whole statement into the server's log, with answers,
--     notes, facts and tokens. The work is done in functions whose names begin with server_do_; the end of this file wraps them.
--
-- Errors: VH101 wrong input. VH102 the participant was erased. VH103 the participant is of another kind. VH104 bad id.
-- VH105 the login lacks a right. VH201 the station's name is in use. VH202 another station has the participant. VH203 the
-- presentation is not due. VH204 another station went on. VH205 this connection has not joined or claimed. VH206 the study is
-- being moved. VH207 all slots are taken. VH208 the answer is stored already. VH209 there is no answer to correct. VH210 a table
-- is append-only. VH211 the presentation was not released. VH212 the participant has withdrawn. VH213 the transaction is not
-- of its own. VH214 the study is not complete. VH301 the database is of another kind. VH302 the study is busy. VH303 the groups
-- of the study (roles.sql) are those of another study, or have members of an earlier one.

-- The bytes that are hashed: protocols/files/canonical_bytes.h. Without the casts to text the planner could not inline these
-- functions.

CREATE OR REPLACE FUNCTION @schema@.server_field(value text) RETURNS text LANGUAGE sql IMMUTABLE AS
$$ SELECT CASE WHEN value IS NULL THEN '-,' ELSE octet_length(value)::text || ':' || value || ',' END $$;

CREATE OR REPLACE FUNCTION @schema@.server_field(value bigint) RETURNS text LANGUAGE sql IMMUTABLE AS
$$ SELECT CASE WHEN value IS NULL THEN '-,' ELSE length(value::text)::text || ':' || value::text || ',' END $$;

CREATE OR REPLACE FUNCTION @schema@.server_hash(bytes text) RETURNS text LANGUAGE sql IMMUTABLE AS
$$ SELECT encode(sha256(convert_to(bytes, 'UTF8')), 'hex') $$;

-- 32 random bytes, in hexadecimal.
CREATE OR REPLACE FUNCTION @schema@.server_salt() RETURNS text LANGUAGE sql VOLATILE AS
$$ SELECT encode(sha256(uuid_send(gen_random_uuid()) || uuid_send(gen_random_uuid()) || uuid_send(gen_random_uuid())), 'hex') $$;

CREATE OR REPLACE FUNCTION @schema@.server_wall_time() RETURNS text LANGUAGE sql VOLATILE AS
$$ SELECT to_char(clock_timestamp() AT TIME ZONE 'UTC', 'YYYY-MM-DD"T"HH24:MI:SS.MS"Z"') $$;

CREATE OR REPLACE FUNCTION @schema@.server_head() RETURNS jsonb LANGUAGE sql STABLE AS
$$ SELECT coalesce((SELECT jsonb_build_object('sequence', e.sequence, 'hash', e.hash) FROM @schema@.events e
                    ORDER BY e.sequence DESC LIMIT 1),
                   jsonb_build_object('sequence', 0, 'hash', '')) $$;

-- Rules for texts: protocols/files/id_rule.cpp.

CREATE OR REPLACE FUNCTION @schema@.server_fault_of_character(code int) RETURNS text LANGUAGE sql IMMUTABLE AS
$$ SELECT CASE
    WHEN code < 32 OR code BETWEEN 127 AND 159 THEN 'holds a control character'
    WHEN code IN (173, 847, 1564, 4447, 4448, 6068, 6069, 6158, 8203, 10240, 12644, 65279, 65440) OR code BETWEEN 8206 AND 8207 OR code BETWEEN 8232 AND 8238
         OR code BETWEEN 8288 AND 8303 OR code BETWEEN 65529 AND 65531 OR code BETWEEN 65534 AND 65535
         OR code BETWEEN 917504 AND 917631 THEN 'holds an invisible character'
    ELSE '' END $$;

-- Joiners and selectors of forms behind a letter or digit of ASCII, where an id hides them.
CREATE OR REPLACE FUNCTION @schema@.server_has_hidden_form(value text) RETURNS boolean LANGUAGE sql IMMUTABLE AS
$$ SELECT value ~ ('[0-9A-Za-z][' || chr(6155) || '-' || chr(6159) || chr(8204) || chr(8205) || chr(65024) || '-' || chr(65039)
                   || chr(917760) || '-' || chr(917999) || ']') $$;

CREATE OR REPLACE FUNCTION @schema@.server_is_blank(code int) RETURNS boolean LANGUAGE sql IMMUTABLE AS
$$ SELECT code IN (32, 160, 5760, 8239, 8287, 12288) OR code BETWEEN 8192 AND 8202 $$;

-- What the id breaks in the rule; empty for a good id.
CREATE OR REPLACE FUNCTION @schema@.server_fault_of_id(id text) RETURNS text LANGUAGE plpgsql IMMUTABLE AS $$
DECLARE
    code int;
    fault text;
    ends_blank boolean := false;
BEGIN
    IF id IS NULL OR id = '' THEN RETURN 'is empty'; END IF;
    IF octet_length(id) > 64 THEN RETURN 'has ' || octet_length(id) || ' bytes'; END IF;
    IF @schema@.server_has_hidden_form(id) THEN RETURN 'holds an invisible character'; END IF;
    IF left(id, 1) = '.' THEN RETURN 'begins with a dot'; END IF;
    IF left(id, 1) = '-' THEN RETURN 'begins with a dash'; END IF;
    FOR place IN 1 .. length(id) LOOP
        code := ascii(substr(id, place, 1));
        fault := @schema@.server_fault_of_character(code);
        IF fault <> '' THEN RETURN fault; END IF;
        IF code IN (47, 92) THEN RETURN 'holds a slash or backslash'; END IF;
        IF code = 44 THEN RETURN 'holds a comma'; END IF;
        ends_blank := @schema@.server_is_blank(code);
        IF place = 1 AND ends_blank THEN RETURN 'begins with a blank'; END IF;
    END LOOP;
    RETURN CASE WHEN ends_blank THEN 'ends with a blank' ELSE '' END;
END
$$;

-- What the line breaks in the rule; empty for a good one.
CREATE OR REPLACE FUNCTION @schema@.server_fault_of_line(line text, most_bytes int) RETURNS text LANGUAGE plpgsql IMMUTABLE AS $$
DECLARE
    code int;
    fault text;
    has_words boolean := false;
BEGIN
    IF octet_length(line) > most_bytes THEN RETURN 'has ' || octet_length(line) || ' bytes'; END IF;
    FOR place IN 1 .. coalesce(length(line), 0) LOOP
        code := ascii(substr(line, place, 1));
        fault := @schema@.server_fault_of_character(code);
        IF fault <> '' THEN RETURN fault; END IF;
        has_words := has_words OR NOT @schema@.server_is_blank(code);
    END LOOP;
    RETURN CASE WHEN has_words THEN '' ELSE 'is empty' END;
END
$$;

CREATE OR REPLACE FUNCTION @schema@.server_require_line(line text, named text) RETURNS void LANGUAGE plpgsql IMMUTABLE AS $$
DECLARE
    fault text := @schema@.server_fault_of_line(line, 100);
BEGIN
    IF fault <> '' THEN
        RAISE EXCEPTION USING ERRCODE = 'VH101', MESSAGE = named || ' ' || fault,
            DETAIL = 'one line of 1 to 100 bytes of UTF-8 without control or invisible characters',
            HINT = 'choose another name';
    END IF;
END
$$;

-- The fields of an entry. `place` names where the field is, such as "answers[0].". What a person typed has at most 100000 bytes,
-- and a payload 1000000: longestText and longestPayload in database/session_store.h, which a session keeps.

CREATE OR REPLACE FUNCTION @schema@.server_wrong_field(name text, expected text) RETURNS void LANGUAGE plpgsql AS $$
BEGIN
    RAISE EXCEPTION USING ERRCODE = 'VH101', MESSAGE = 'the field "' || name || '" of the entry is missing or wrong',
        DETAIL = expected, HINT = 'use a program of the same version as the study';
END
$$;

-- isKeptText() in protocols/files/utf8.h: other texts come back changed.
CREATE OR REPLACE FUNCTION @schema@.server_is_kept_text(value text) RETURNS boolean LANGUAGE sql IMMUTABLE AS
$$ SELECT translate(value, chr(65279) || chr(65534) || chr(65535), '') = value $$;

CREATE OR REPLACE FUNCTION @schema@.server_text(object jsonb, name text, longest int, may_be_null boolean DEFAULT false,
                                                place text DEFAULT '') RETURNS text LANGUAGE plpgsql AS $$
DECLARE
    kind text := jsonb_typeof(object -> name);
    value text;
BEGIN
    IF kind = 'null' AND may_be_null THEN RETURN NULL; END IF;
    IF kind = 'string' THEN
        value := object ->> name;
        IF octet_length(value) <= longest AND @schema@.server_is_kept_text(value) THEN RETURN value; END IF;
    END IF;
    PERFORM @schema@.server_wrong_field(place || name, 'a text of at most ' || longest || ' bytes, each character of it visible'
                                        || CASE WHEN may_be_null THEN ', or null' ELSE '' END);
END
$$;

CREATE OR REPLACE FUNCTION @schema@.server_whole(object jsonb, name text, may_be_null boolean DEFAULT false,
                                                 place text DEFAULT '', lowest bigint DEFAULT -9223372036854775808,
                                                 highest bigint DEFAULT 9223372036854775807)
    RETURNS bigint LANGUAGE plpgsql AS $$
DECLARE
    kind text := jsonb_typeof(object -> name);
    digits text;
BEGIN
    IF kind = 'null' AND may_be_null THEN RETURN NULL; END IF;
    IF kind = 'number' THEN
        digits := object ->> name;
        IF digits ~ '^-?[0-9]{1,19}$' AND digits::numeric BETWEEN lowest AND highest THEN RETURN digits::bigint; END IF;
    END IF;
    PERFORM @schema@.server_wrong_field(place || name, 'a whole number from ' || lowest || ' to ' || highest
                                        || CASE WHEN may_be_null THEN ', or null' ELSE '' END);
END
$$;

-- A reading of a clock in ns, as sessions take it: 73 years at most.
CREATE OR REPLACE FUNCTION @schema@.server_stamp(object jsonb, name text, may_be_null boolean DEFAULT false,
                                                 place text DEFAULT '') RETURNS bigint LANGUAGE sql AS
$$ SELECT @schema@.server_whole(object, name, may_be_null, place, -2305843009213693951, 2305843009213693951) $$;

CREATE OR REPLACE FUNCTION @schema@.server_yes(object jsonb, name text, place text DEFAULT '') RETURNS bigint
    LANGUAGE plpgsql AS $$
BEGIN
    IF object -> name IN ('true'::jsonb, '1'::jsonb) THEN RETURN 1; END IF;
    IF object -> name IN ('false'::jsonb, '0'::jsonb) THEN RETURN 0; END IF;
    PERFORM @schema@.server_wrong_field(place || name, 'true or false');
END
$$;

-- The value of the field where it is of this type; NULL where it is null.
CREATE OR REPLACE FUNCTION @schema@.server_part(object jsonb, name text, kind text) RETURNS jsonb LANGUAGE plpgsql AS $$
BEGIN
    IF jsonb_typeof(object -> name) = 'null' THEN RETURN NULL; END IF;
    IF jsonb_typeof(object -> name) = kind THEN RETURN object -> name; END IF;
    PERFORM @schema@.server_wrong_field(name, 'null, or the JSON type ' || kind);
END
$$;

-- An object that this program can read as well as PostgreSQL: without the character of code 0, numbers that no double holds, and
-- deep nesting (50 brackets; the program writes some five). Of a name that occurs twice jsonb keeps one value, so that numbers and
-- brackets are looked for in the text.
CREATE OR REPLACE FUNCTION @schema@.server_is_json_object(value text) RETURNS boolean LANGUAGE plpgsql IMMUTABLE AS $$
DECLARE
    without_texts text;
BEGIN
    without_texts := regexp_replace(value, '"([^"\\]|\\.)*"', '', 'g');
    RETURN coalesce(jsonb_typeof(value::jsonb) = 'object' AND without_texts !~ '[eE][+]?[0-9]{3}|[0-9]{200}'
                    AND length(translate(without_texts, '[{', '')) > length(without_texts) - 50, false);
EXCEPTION
    WHEN data_exception OR statement_too_complex OR program_limit_exceeded THEN RETURN false;
END
$$;

-- Locks and connections.

-- A later statement of a transaction at a higher level does not see what others stored. From here on the transaction is on the
-- disk when it returns, whatever database or login have set: an image must not go out without the record of its release.
CREATE OR REPLACE FUNCTION @schema@.server_require_statement() RETURNS void LANGUAGE plpgsql AS $$
BEGIN
    IF current_setting('transaction_isolation') <> 'read committed' THEN
        RAISE EXCEPTION USING ERRCODE = 'VH213', MESSAGE = 'the transaction has the isolation level '
                || current_setting('transaction_isolation'),
            DETAIL = 'read committed',
            HINT = 'call the function outside a transaction, with default_transaction_isolation = ''read committed''';
    END IF;
    IF current_setting('synchronous_commit') = 'off' THEN PERFORM set_config('synchronous_commit', 'on', true); END IF;
END
$$;

CREATE OR REPLACE FUNCTION @schema@.server_require_fresh_transaction() RETURNS void LANGUAGE plpgsql AS $$
BEGIN
    PERFORM @schema@.server_require_statement();
    IF pg_current_xact_id_if_assigned() IS NOT NULL THEN
        RAISE EXCEPTION USING ERRCODE = 'VH213', MESSAGE = 'the transaction has written already',
            DETAIL = 'a transaction of its own', HINT = 'call the function outside a transaction';
    END IF;
END
$$;

CREATE OR REPLACE FUNCTION @schema@.server_refuse_busy() RETURNS void LANGUAGE plpgsql AS $$
BEGIN
    RAISE EXCEPTION USING ERRCODE = 'VH302', MESSAGE = 'another connection keeps the study busy',
        DETAIL = 'a free study within ' || rtrim(current_setting('lock_timeout'), 's') || ' seconds', HINT = 'try again';
END
$$;

-- Entries are appended one after the other: the lock lasts until the transaction ends.
CREATE OR REPLACE FUNCTION @schema@.server_lock(needs_open boolean) RETURNS void LANGUAGE plpgsql AS $$
DECLARE
    state text;
BEGIN
    PERFORM @schema@.server_require_statement();
    BEGIN
        SELECT s.state INTO state FROM @schema@.server_study s WHERE s.id = 1 FOR UPDATE;
    EXCEPTION
        WHEN lock_not_available THEN PERFORM @schema@.server_refuse_busy();
    END;
    IF needs_open AND state IS DISTINCT FROM 'open' THEN
        RAISE EXCEPTION USING ERRCODE = 'VH206', MESSAGE = 'the study is being moved',
            DETAIL = 'a study whose move is complete', HINT = 'ask its owner where it is now';
    END IF;
END
$$;

-- The advisory locks that connections to this database hold.
CREATE OR REPLACE FUNCTION @schema@.server_signs() RETURNS TABLE(pid int, sign bigint) LANGUAGE sql STABLE AS
$$ SELECT l.pid, l.classid::bigint << 32 | l.objid::bigint FROM pg_locks l
   WHERE l.locktype = 'advisory' AND l.granted AND l.mode = 'ExclusiveLock' AND l.objsubid = 1
     AND l.database = (SELECT d.oid FROM pg_database d WHERE d.datname = current_database()) $$;

-- Whether the process holds the sign of its station.
CREATE OR REPLACE FUNCTION @schema@.server_is_live(process int, its_sign bigint) RETURNS boolean LANGUAGE sql STABLE AS
$$ SELECT EXISTS (SELECT FROM @schema@.server_signs() s WHERE s.pid = process AND s.sign = its_sign) $$;

-- Keeps on record what the connection of a station may owe that has ended. The caller removes it from the station's row.
CREATE OR REPLACE FUNCTION @schema@.server_keep_owed(ended @schema@.server_stations) RETURNS void LANGUAGE sql AS $$
    INSERT INTO @schema@.server_owed(token, participant, station, login, queue_length)
    SELECT ended.token, coalesce(ended.participant, ''), ended.station, ended.login, ended.queue_length
    WHERE ended.participant IS NOT NULL OR ended.queue_length > 0
    ON CONFLICT (token, participant) DO UPDATE
        SET station = excluded.station, login = excluded.login,
            queue_length = greatest(server_owed.queue_length, excluded.queue_length)
$$;

-- The row of this connection, locked; a row of NULLs where it has not joined.
CREATE OR REPLACE FUNCTION @schema@.server_own_station() RETURNS @schema@.server_stations LANGUAGE plpgsql AS $$
DECLARE
    own @schema@.server_stations;
BEGIN
    SELECT * INTO own FROM @schema@.server_stations s
    WHERE s.pid = pg_backend_pid() AND s.login = session_user AND @schema@.server_is_live(s.pid, s.sign) FOR UPDATE;
    RETURN own;
EXCEPTION
    WHEN lock_not_available THEN PERFORM @schema@.server_refuse_busy();
END
$$;

CREATE OR REPLACE FUNCTION @schema@.server_require_station() RETURNS @schema@.server_stations LANGUAGE plpgsql AS $$
DECLARE
    own @schema@.server_stations := @schema@.server_own_station();
BEGIN
    IF own.station IS NULL THEN
        RAISE EXCEPTION USING ERRCODE = 'VH205', MESSAGE = 'this connection has not joined the study',
            DETAIL = 'a station that has joined', HINT = 'join the study, then repeat the step';
    END IF;
    RETURN own;
END
$$;

-- The own station, which must hold the participant; any participant where `wanted` is null.
CREATE OR REPLACE FUNCTION @schema@.server_require_claim(wanted text) RETURNS @schema@.server_stations LANGUAGE plpgsql AS $$
DECLARE
    own @schema@.server_stations := @schema@.server_require_station();
BEGIN
    IF own.participant IS NULL OR own.participant <> coalesce(wanted, own.participant) THEN
        RAISE EXCEPTION USING ERRCODE = 'VH205',
            MESSAGE = 'this station has not claimed ' || coalesce('participant ' || left(wanted, 64), 'a participant'),
            DETAIL = 'the participant of this station', HINT = 'claim the participant, then repeat the step';
    END IF;
    RETURN own;
END
$$;

-- The chain: database/event_chain.cpp. The caller holds server_lock(). `content`: the canonical bytes of the entry's rows.
CREATE OR REPLACE FUNCTION @schema@.server_append(participant text, sitting bigint, kind text, payload text, at_ns bigint,
                                                  wall_time text, places text DEFAULT '', content text DEFAULT '')
    RETURNS bigint LANGUAGE plpgsql AS $$
DECLARE
    number bigint;
    previous text;
    salt text := @schema@.server_salt();
    commitment text;
BEGIN
    SELECT e.sequence + 1, e.hash INTO number, previous FROM @schema@.events e ORDER BY e.sequence DESC LIMIT 1;
    IF number IS NULL THEN
        number := 1;
        previous := '';
    END IF;
    commitment := @schema@.server_hash(@schema@.server_field(salt) || @schema@.server_field(payload)
        || @schema@.server_field(at_ns) || @schema@.server_field(wall_time) || content);
    INSERT INTO @schema@.events(sequence, participant, sitting, kind, places, payload, at_ns, wall_time, salt, commitment,
                                previous_hash, hash)
    VALUES (number, participant, sitting, kind, places, payload, at_ns, wall_time, salt, commitment, previous,
            @schema@.server_hash(@schema@.server_field(previous) || @schema@.server_field(number)
                || @schema@.server_field(participant) || @schema@.server_field(sitting) || @schema@.server_field(kind)
                || @schema@.server_field(places) || @schema@.server_field(commitment)));
    RETURN number;
END
$$;

-- The present attempt at a trial: one more than its voids.
CREATE OR REPLACE FUNCTION @schema@.server_attempt(its_participant text, its_trial bigint) RETURNS bigint LANGUAGE sql STABLE AS
$$ SELECT 1 + count(*) FROM @schema@.voids v WHERE v.participant = its_participant AND v.trial = its_trial $$;

-- A JSON list of lists of question ids: the phases of the participant's version of the protocol.
CREATE OR REPLACE FUNCTION @schema@.server_phases(version bigint) RETURNS jsonb LANGUAGE sql STABLE AS
$$ SELECT s.phase_questions -> version::text FROM @schema@.server_study s WHERE s.id = 1 $$;

-- The trial as clients see it; trays and sealed codes only of released ones.
CREATE OR REPLACE FUNCTION @schema@.server_trial(t @schema@.trials, is_released boolean) RETURNS jsonb LANGUAGE sql STABLE AS
$$ SELECT jsonb_build_object('number', t.number, 'phase', t.phase, 'presentation_code', t.presentation_code,
                             'instruction', t.instruction, 'aim', t.aim, 'deadline_ms', t.deadline_ms)
       || CASE WHEN is_released
               THEN jsonb_build_object('alternatives', t.alternatives, 'sealed_code', t.sealed_code) ELSE '{}' END $$;

-- Whether the participant has had the presentation: at a station, or before the study was moved to this server.
CREATE OR REPLACE FUNCTION @schema@.server_was_given(its_participant text, its_trial bigint) RETURNS boolean
    LANGUAGE sql STABLE AS $$
    SELECT EXISTS (SELECT FROM @schema@.server_releases r WHERE r.participant = its_participant AND r.trial = its_trial)
        OR EXISTS (SELECT FROM @schema@.responses r WHERE r.participant = its_participant AND r.trial = its_trial)
        OR EXISTS (SELECT FROM @schema@.voids v WHERE v.participant = its_participant AND v.trial = its_trial)
$$;

-- Whether the slot of the participant waits for release_held(): who withdraws at a station may have seen the presentations that
-- the next participant in the slot would get. server_releases cannot say so of trays and codes, because a login can roll back a
-- release; it has an image only of one that stands. The owner's own logins could read the slot anyway.
CREATE OR REPLACE FUNCTION @schema@.server_holds_slot(its @schema@.participants) RETURNS boolean LANGUAGE sql STABLE AS $$
    SELECT its.state = 'withdrawn'
       AND NOT EXISTS (SELECT FROM @schema@.server_cleared c WHERE c.participant = its.id AND c.state = 'withdrawn')
       AND EXISTS (SELECT FROM @schema@.server_received r
                   WHERE r.participant = its.id
                     AND r.login NOT IN (SELECT o.rolname FROM pg_roles o WHERE pg_has_role(o.oid, current_user, 'MEMBER')))
$$;

-- Whether the next presentation of the participant waits for release_held(): three voids since the last answer that stands.
CREATE OR REPLACE FUNCTION @schema@.server_holds_next(its @schema@.participants) RETURNS boolean LANGUAGE sql STABLE AS $$
    SELECT its.state = 'started' AND count(*) >= 3
    FROM @schema@.voids v
    WHERE v.participant = its.id
      AND v.event > coalesce((SELECT max(r.event) FROM @schema@.responses r
                              WHERE r.participant = its.id AND r.is_correction = 0
                                AND NOT EXISTS (SELECT FROM @schema@.voids w WHERE w.participant = r.participant
                                                AND w.trial = r.trial AND w.attempt = r.attempt)), 0)
      AND v.event > coalesce((SELECT max(c.event) FROM @schema@.server_cleared c WHERE c.participant = its.id), 0)
$$;

-- Whether nobody new may have the slot.
CREATE OR REPLACE FUNCTION @schema@.server_is_taken(its_slot bigint) RETURNS boolean LANGUAGE sql STABLE AS $$
    SELECT EXISTS (SELECT FROM @schema@.participants p
                   WHERE p.slot = its_slot AND (p.state <> 'withdrawn' OR @schema@.server_holds_slot(p)))
$$;

CREATE OR REPLACE FUNCTION @schema@.server_overview() RETURNS jsonb LANGUAGE sql STABLE AS $$
    WITH given AS (
        SELECT r.participant, count(*) AS number FROM @schema@.responses r WHERE r.is_correction = 0 GROUP BY r.participant),
    voided AS (
        SELECT r.participant, count(*) AS number
        FROM @schema@.voids v
        JOIN @schema@.responses r ON r.participant = v.participant AND r.trial = v.trial AND r.attempt = v.attempt
        WHERE r.is_correction = 0 GROUP BY r.participant),
    places AS (
        SELECT p.slot, p.position, jsonb_build_object('slot', p.slot, 'state', p.state, 'participant', p.id, 'kind', p.kind,
                                                      'answers', coalesce(g.number, 0) - coalesce(v.number, 0)) AS place
        FROM @schema@.participants p
        LEFT JOIN given g ON g.participant = p.id
        LEFT JOIN voided v ON v.participant = p.id
        UNION ALL
        SELECT s.number, NULL, jsonb_build_object('slot', s.number, 'state', 'free', 'participant', '', 'kind', '', 'answers', 0)
        FROM @schema@.slots s
        WHERE NOT @schema@.server_is_taken(s.number))
    SELECT jsonb_build_object(
        'images_to', (SELECT s.images_to FROM @schema@.server_study s WHERE s.id = 1),
        'places', coalesce((SELECT jsonb_agg(place ORDER BY slot, position NULLS LAST) FROM places), '[]'),
        'participants', coalesce((SELECT jsonb_agg(p.id ORDER BY p.position) FROM @schema@.participants p), '[]'))
$$;

-- What a station may call.

CREATE OR REPLACE FUNCTION @schema@.server_do_join_study(station text, token text, program text) RETURNS jsonb
    LANGUAGE plpgsql AS $$
DECLARE
    its_station text := station;
    its_token text := token;
    its_program text := program;
    own @schema@.server_stations;
    same @schema@.server_stations;
    new_sign bigint;
BEGIN
    PERFORM @schema@.server_require_line(its_station, 'the name of the station');
    PERFORM @schema@.server_require_line(its_program, 'the name of the program');
    IF its_token IS NULL OR its_token !~ '^[0-9a-f]{64}$' THEN
        PERFORM @schema@.server_wrong_field('token', '64 hexadecimal digits');
    END IF;
    PERFORM @schema@.server_lock(false);
    SELECT * INTO same FROM @schema@.server_stations s WHERE s.station = its_station;
    -- After a cut network the same station comes back before the server has noticed: its token takes the old connection's place.
    IF same.pid <> pg_backend_pid() AND same.token <> its_token AND @schema@.server_is_live(same.pid, same.sign) THEN
        RAISE EXCEPTION USING ERRCODE = 'VH201', MESSAGE = 'another connection has joined as station ' || its_station,
            DETAIL = 'a name for each station',
            HINT = 'close the other program, or join with another name: vis2hap study join ADDRESS --station NAME';
    END IF;
    own := @schema@.server_own_station();
    IF own.station IS NOT NULL THEN PERFORM pg_advisory_unlock(own.sign); END IF;
    -- A station that joins again on the same connection has left its participant, and nothing waits. One that comes back on
    -- another connection may still have to send what waits; so may the one whose name it takes.
    IF same.station IS DISTINCT FROM own.station THEN PERFORM @schema@.server_keep_owed(same); END IF;
    IF own.queue_length > 0 THEN PERFORM @schema@.server_keep_owed(own); END IF;
    -- Monitors see a station that is gone for one day. One that may owe answers stays. A process of a server that started again
    -- may have the number of its last connection, but not its lock.
    DELETE FROM @schema@.server_stations s
    WHERE s.station = its_station OR s.station = own.station
       OR (s.last_seen < clock_timestamp() - interval '1 day' AND s.participant IS NULL AND s.queue_length = 0
           AND NOT @schema@.server_is_live(s.pid, s.sign));
    new_sign := ('x' || left(@schema@.server_salt(), 16))::bit(64)::bigint;
    PERFORM pg_advisory_lock(new_sign);
    INSERT INTO @schema@.server_stations(station, token, login, pid, sign, program)
    VALUES (its_station, its_token, session_user, pg_backend_pid(), new_sign, its_program);
    -- The server sees a cut network within 20 seconds, so that another station can go on. A program that hangs in a transaction
    -- does not keep the study busy.
    PERFORM set_config('tcp_keepalives_idle', '5', false), set_config('tcp_keepalives_interval', '5', false),
            set_config('tcp_keepalives_count', '3', false), set_config('tcp_user_timeout', '20000', false),
            set_config('idle_in_transaction_session_timeout', '5000', false);
    RETURN (SELECT jsonb_build_object(
        'name', s.name, 'protocol_version', (SELECT coalesce(max(v.version), 1) FROM @schema@.protocol_versions v),
        'protocol_json', coalesce((SELECT v.json FROM @schema@.protocol_versions v ORDER BY v.version DESC LIMIT 1),
                                  s.protocol_json),
        'protocol_sha256', coalesce((SELECT v.sha256 FROM @schema@.protocol_versions v ORDER BY v.version DESC LIMIT 1),
                                    s.protocol_sha256),
        'made_with_program', s.program_version,
        'has_passphrase', s.has_passphrase <> 0, 'stamps', s.stamps::jsonb, 'created_at', s.created_at,
        'dataset_procedural', s.dataset_procedural <> 0,
        'fabrics', coalesce((SELECT jsonb_agg(jsonb_build_object('id', f.id, 'name', f.name) ORDER BY f.position)
                             FROM @schema@.fabrics f), '[]'),
        'familiarisation', coalesce((SELECT jsonb_agg(jsonb_build_object('name', f.name, 'position', f.position)
                                                      ORDER BY f.position) FROM @schema@.familiarisation f), '[]'),
        'head', @schema@.server_head(), 'state', (SELECT t.state FROM @schema@.server_study t WHERE t.id = 1),
        'images_to', (SELECT t.images_to FROM @schema@.server_study t WHERE t.id = 1))
        FROM @schema@.study s);
END
$$;

CREATE OR REPLACE FUNCTION @schema@.overview() RETURNS jsonb LANGUAGE sql STABLE SECURITY DEFINER
    SET search_path = pg_catalog, pg_temp SET client_min_messages = warning AS
$$ SELECT @schema@.server_overview() $$;

-- Enrols as enrolIn() in database/study_writing.cpp. The entry names the last act, as nameLastAct() in database/event_chain.cpp
-- does it for a folder; stations keep copies of the other entries, so the server adds nothing to them. The caller holds
-- server_lock().
CREATE OR REPLACE FUNCTION @schema@.server_enrol(its_id text, its_kind text) RETURNS @schema@.participants LANGUAGE plpgsql AS $$
DECLARE
    known @schema@.participants;
    fault text;
    free bigint;
    version bigint;
BEGIN
    IF EXISTS (SELECT FROM @schema@.erasures e WHERE e.participant = its_id AND e.answers_too <> 0) THEN
        RAISE EXCEPTION USING ERRCODE = 'VH102', MESSAGE = 'participant ' || its_id || ' was erased',
            DETAIL = 'another id', HINT = 'choose another id';
    END IF;
    SELECT * INTO known FROM @schema@.participants p WHERE p.id = its_id;
    IF FOUND THEN
        IF known.kind <> its_kind THEN
            RAISE EXCEPTION USING ERRCODE = 'VH103',
                MESSAGE = 'participant ' || its_id || ' is ' || known.kind || ', not ' || its_kind,
                DETAIL = 'another id', HINT = 'choose another id';
        END IF;
        RETURN known;
    END IF;
    fault := @schema@.server_fault_of_id(its_id);
    IF fault <> '' THEN
        RAISE EXCEPTION USING ERRCODE = 'VH104',
            MESSAGE = CASE WHEN octet_length(its_id) > 64 THEN 'an id of a participant' ELSE '"' || coalesce(its_id, '') || '"' END
                || ' cannot name a participant: it ' || fault,
            DETAIL = '1 to 64 bytes of UTF-8 without control or invisible characters, slashes, backslashes and commas, that begin '
                || 'with no dot, dash or blank and end with no blank',
            HINT = 'choose another id';
    END IF;
    -- faultOfNewId(): a table would read this id as a missing value.
    IF lower(its_id) IN ('na', 'nan', 'null', 'none') THEN
        RAISE EXCEPTION USING ERRCODE = 'VH104',
            MESSAGE = '"' || its_id || '" cannot name a participant: it stands for a missing value in tables',
            DETAIL = 'another id than NA, NaN, null and None in any case', HINT = 'choose another id';
    END IF;
    SELECT s.number INTO free FROM @schema@.slots s
    WHERE NOT @schema@.server_is_taken(s.number)
    ORDER BY s.number LIMIT 1;
    IF free IS NULL THEN
        RAISE EXCEPTION USING ERRCODE = 'VH207', MESSAGE = 'all slots of the study are taken',
            DETAIL = 'a free slot for ' || its_id,
            HINT = CASE WHEN EXISTS (SELECT FROM @schema@.participants p WHERE @schema@.server_holds_slot(p))
                        THEN 'ask the owner to give out slots of those who withdrew: vis2hap server roles ADDRESS --release-held'
                        ELSE 'make a study with more participants' END;
    END IF;
    SELECT coalesce(max(v.version), 1) INTO version FROM @schema@.protocol_versions v;
    INSERT INTO @schema@.participants(id, slot, kind, state, protocol_version) VALUES (its_id, free, its_kind, 'started', version)
    RETURNING * INTO known;
    PERFORM @schema@.server_append('', 0, 'enrolled',
        '{"slot":' || free || ',"participant":' || to_json(its_id) || ',"kind":' || to_json(its_kind)
            || CASE WHEN version > 1 THEN ',"protocol_version":' || version ELSE '' END
            || coalesce((SELECT ',"acts":{"number":' || a.number || ',"sha256":' || to_json(a.hash) || '}'
                         FROM @schema@.acts a ORDER BY a.number DESC LIMIT 1), '') || '}',
        0, @schema@.server_wall_time());
    RETURN known;
END
$$;

CREATE OR REPLACE FUNCTION @schema@.server_do_claim(participant text, kind text) RETURNS jsonb LANGUAGE plpgsql AS $$
DECLARE
    its_id text := participant;
    own @schema@.server_stations;
    holder @schema@.server_stations;
    its @schema@.participants;
BEGIN
    PERFORM @schema@.server_require_fresh_transaction();
    IF kind IS NULL OR kind NOT IN ('human', 'scripted', 'simulated') THEN
        RAISE EXCEPTION USING ERRCODE = 'VH101', MESSAGE = 'the kind of the participant is unknown',
            DETAIL = 'human, scripted or simulated', HINT = 'choose one of these';
    END IF;
    IF kind <> 'human' AND NOT pg_has_role(session_user, current_user, 'MEMBER') THEN
        RAISE EXCEPTION USING ERRCODE = 'VH105', MESSAGE = 'only the owner of the study may enrol ' || kind || ' participants',
            DETAIL = 'a human participant, or the login of the owner', HINT = 'ask the owner of the study';
    END IF;
    PERFORM @schema@.server_lock(true);
    own := @schema@.server_require_station();
    SELECT * INTO holder FROM @schema@.server_stations s WHERE s.participant = its_id AND s.station <> own.station;
    IF FOUND THEN
        IF @schema@.server_is_live(holder.pid, holder.sign) THEN
            RAISE EXCEPTION USING ERRCODE = 'VH202',
                MESSAGE = 'participant ' || its_id || ' is at station ' || holder.station,
                DETAIL = 'a participant at one station at a time', HINT = 'end the session at the other station first';
        END IF;
        PERFORM @schema@.server_keep_owed(holder);
        UPDATE @schema@.server_stations s SET participant = NULL, queue_length = 0 WHERE s.station = holder.station;
    END IF;
    its := @schema@.server_enrol(its_id, kind);
    UPDATE @schema@.server_stations s SET participant = its_id, last_seen = clock_timestamp() WHERE s.station = own.station;
    RETURN jsonb_build_object(
        'slot', its.slot, 'state', its.state, 'kind', its.kind, 'protocol_version', its.protocol_version,
        'protocol_json', coalesce((SELECT v.json FROM @schema@.protocol_versions v WHERE v.version = its.protocol_version),
                                  (SELECT s.protocol_json FROM @schema@.study s)),
        'swatches', coalesce((SELECT jsonb_object_agg(s.fabric, s.code) FROM @schema@.swatches s WHERE s.slot = its.slot), '{}'),
        'trials', coalesce((
            SELECT jsonb_agg(@schema@.server_trial(t, @schema@.server_was_given(its_id, t.number)) ORDER BY t.number)
            FROM @schema@.trials t WHERE t.slot = its.slot), '[]'),
        'events', coalesce((
            SELECT jsonb_agg(jsonb_build_object('sequence', e.sequence, 'sitting', e.sitting, 'kind', e.kind, 'payload', e.payload,
                                                'at_ns', e.at_ns, 'wall_time', e.wall_time) ORDER BY e.sequence)
            FROM @schema@.events e WHERE e.participant = its_id), '[]'),
        'head', @schema@.server_head());
END
$$;

-- Whether every question of every trial has an answer in its present attempt. A session presents a void trial again before it
-- ends, and takes an answer to each question: no answer is left out, and none is recorded as missing.
CREATE OR REPLACE FUNCTION @schema@.server_is_answered(its @schema@.participants) RETURNS boolean LANGUAGE sql STABLE AS $$
    SELECT NOT EXISTS (
        SELECT FROM @schema@.trials t
        CROSS JOIN LATERAL (SELECT @schema@.server_attempt(its.id, t.number) AS attempt) present
        CROSS JOIN LATERAL jsonb_array_elements_text(@schema@.server_phases(its.protocol_version) -> t.phase::int) asked(question)
        WHERE t.slot = its.slot AND NOT EXISTS (
            SELECT FROM @schema@.responses r
            WHERE r.participant = its.id AND r.trial = t.number AND r.attempt = present.attempt
              AND r.question = asked.question AND r.is_correction = 0))
$$;

-- The lowest trial that the participant has not had, where the present attempt at every trial before it is answered whole. A void
-- lets a trial wait: the session presents it again later. Three voids without an answer between them let nothing pass.
CREATE OR REPLACE FUNCTION @schema@.server_due(its @schema@.participants) RETURNS bigint LANGUAGE plpgsql STABLE AS $$
DECLARE
    phases jsonb := @schema@.server_phases(its.protocol_version);
BEGIN
    IF its.state <> 'started' OR jsonb_typeof(phases) IS DISTINCT FROM 'array' OR @schema@.server_holds_next(its) THEN
        RETURN NULL;
    END IF;
    IF EXISTS (
        SELECT FROM @schema@.trials t
        CROSS JOIN LATERAL (SELECT @schema@.server_attempt(its.id, t.number) AS attempt) present
        CROSS JOIN LATERAL (
            SELECT count(*) AS asked,
                   count(*) FILTER (WHERE EXISTS (
                       SELECT FROM @schema@.responses a
                       WHERE a.participant = its.id AND a.trial = t.number AND a.attempt = present.attempt
                         AND a.question = asked.question AND a.is_correction = 0)) AS answered
            FROM jsonb_array_elements_text(coalesce(phases -> t.phase::int, '[]')) asked(question)) questions
        WHERE t.slot = its.slot AND @schema@.server_was_given(its.id, t.number)
          AND (questions.asked = 0 OR questions.answered < questions.asked)
          AND (present.attempt = 1 OR questions.answered > 0)) THEN
        RETURN NULL;
    END IF;
    RETURN (SELECT min(t.number) FROM @schema@.trials t
            WHERE t.slot = its.slot AND NOT @schema@.server_was_given(its.id, t.number));
END
$$;

-- Whether the display's own login fetches the image of a ticket, and not the station.
CREATE OR REPLACE FUNCTION @schema@.server_gives_tickets() RETURNS boolean LANGUAGE sql STABLE AS
$$ SELECT s.images_to = 'display' FROM @schema@.server_study s WHERE s.id = 1 $$;

-- Gives a ticket in the place of the image: who takes the release back with a ROLLBACK has no image either.
CREATE OR REPLACE FUNCTION @schema@.presentation(number int) RETURNS TABLE(trial jsonb, image bytea, key text)
    LANGUAGE plpgsql SECURITY DEFINER
    SET search_path = pg_catalog, pg_temp SET client_min_messages = warning SET lock_timeout = '3s' AS $$
DECLARE
    wanted bigint := number;
    own @schema@.server_stations;
    its @schema@.participants;
    its_ticket text := @schema@.server_salt();
BEGIN
    PERFORM @schema@.server_require_fresh_transaction();
    own := @schema@.server_require_claim(NULL);
    IF (SELECT s.state FROM @schema@.server_study s WHERE s.id = 1) IS DISTINCT FROM 'open' THEN
        RAISE EXCEPTION USING ERRCODE = 'VH206', MESSAGE = 'the study is being moved',
            DETAIL = 'a study whose move is complete', HINT = 'ask its owner where it is now';
    END IF;
    SELECT * INTO its FROM @schema@.participants p WHERE p.id = own.participant;
    IF NOT @schema@.server_was_given(its.id, wanted) AND NOT coalesce(wanted = @schema@.server_due(its), false) THEN
        IF @schema@.server_holds_next(its) THEN
            RAISE EXCEPTION USING ERRCODE = 'VH203', MESSAGE = 'three presentations in a row are void, so no new one is given',
                DETAIL = 'an answer between voids',
                HINT = 'ask the owner of the study to let it go on: vis2hap server roles ADDRESS --release-held';
        END IF;
        RAISE EXCEPTION USING ERRCODE = 'VH203', MESSAGE = 'the presentation is not due yet',
            DETAIL = 'the next presentation of the participant, after every answer to those before it',
            HINT = 'store the answers to the present presentation first';
    END IF;
    INSERT INTO @schema@.server_releases(participant, slot, trial, attempt, login, station, ticket)
    VALUES (its.id, its.slot, wanted, @schema@.server_attempt(its.id, wanted), session_user, own.station, its_ticket);
    RETURN QUERY
        SELECT @schema@.server_trial(t, true), convert_to(its_ticket, 'UTF8'), ''::text
        FROM @schema@.trials t
        JOIN @schema@.server_trials s ON s.slot = t.slot AND s.number = t.number
        JOIN @schema@.server_images i ON i.file_code = s.file_code
        WHERE t.slot = its.slot AND t.number = wanted;
    IF NOT FOUND THEN
        RAISE EXCEPTION USING ERRCODE = 'VH214', MESSAGE = 'the image of the presentation is not on the server',
            DETAIL = 'an image for every presentation', HINT = 'ask the owner of the study';
    END IF;
END
$$;

CREATE OR REPLACE FUNCTION @schema@.familiarisation_image(item int) RETURNS TABLE(sealed_code text, image bytea, key text)
    LANGUAGE plpgsql SECURITY DEFINER
    SET search_path = pg_catalog, pg_temp SET client_min_messages = warning SET lock_timeout = '10s' AS $$
BEGIN
    PERFORM @schema@.server_require_claim(NULL);
    RETURN QUERY
        SELECT f.sealed_code,
               CASE WHEN @schema@.server_gives_tickets() THEN convert_to('familiarisation ' || f.position, 'UTF8')
                    ELSE i.sealed END,
               CASE WHEN @schema@.server_gives_tickets() THEN '' ELSE i.key END
        FROM @schema@.familiarisation f
        JOIN @schema@.server_familiarisation s ON s.position = f.position
        JOIN @schema@.server_images i ON i.file_code = s.file_code
        WHERE f.position = item;
    IF NOT FOUND THEN
        RAISE EXCEPTION USING ERRCODE = 'VH101', MESSAGE = 'there is no fabric ' || coalesce(item::text, '')
                || ' for getting to know the display',
            DETAIL = 'a position that join_study() names', HINT = 'join the study again';
    END IF;
END
$$;

-- The image of a ticket, as long as its presentation is the last one that a station at work was given.
CREATE OR REPLACE FUNCTION @schema@.server_image_of(given text, own_station text)
    RETURNS TABLE(about jsonb, image bytea, key text) LANGUAGE plpgsql AS $$
DECLARE
    released @schema@.server_releases;
BEGIN
    SELECT r.* INTO released
    FROM @schema@.server_releases r
    JOIN @schema@.server_stations s ON s.station = r.station AND s.participant = r.participant
    WHERE r.ticket = given AND r.station = coalesce(own_station, r.station) AND @schema@.server_is_live(s.pid, s.sign)
      AND NOT EXISTS (SELECT FROM @schema@.server_releases later WHERE later.station = r.station AND later.number > r.number);
    IF NOT FOUND THEN
        RAISE EXCEPTION USING ERRCODE = 'VH211', MESSAGE = 'the ticket belongs to no present presentation',
            DETAIL = 'the ticket of the presentation that a station has now', HINT = 'present the trial again';
    END IF;
    INSERT INTO @schema@.server_fetches(release, login) VALUES (released.number, session_user);
    RETURN QUERY
        SELECT '{}'::jsonb, i.sealed, i.key
        FROM @schema@.server_trials t JOIN @schema@.server_images i ON i.file_code = t.file_code
        WHERE t.slot = released.slot AND t.number = released.trial;
END
$$;

-- What a station calls after presentation(), where images go to stations. In a transaction that has written, such as that of the
-- presentation, it is refused: the release is on record before the image is given out.
CREATE OR REPLACE FUNCTION @schema@.presented_image(ticket text) RETURNS TABLE(about jsonb, image bytea, key text)
    LANGUAGE plpgsql SECURITY DEFINER
    SET search_path = pg_catalog, pg_temp SET client_min_messages = warning SET lock_timeout = '3s' AS $$
DECLARE
    own @schema@.server_stations;
BEGIN
    PERFORM @schema@.server_require_fresh_transaction();
    own := @schema@.server_require_claim(NULL);
    IF @schema@.server_gives_tickets() THEN
        RAISE EXCEPTION USING ERRCODE = 'VH105', MESSAGE = 'images go to the display''s own login only',
            DETAIL = 'a display that vis2hap display serve offers', HINT = 'open the study again';
    END IF;
    RETURN QUERY SELECT * FROM @schema@.server_image_of(ticket, own.station);
END
$$;

-- What a display may call, where images go to displays. Fabrics for getting to know the display are not of the study: their
-- tickets hold for ever.
CREATE OR REPLACE FUNCTION @schema@.released_image(ticket text) RETURNS TABLE(about jsonb, image bytea, key text)
    LANGUAGE plpgsql SECURITY DEFINER
    SET search_path = pg_catalog, pg_temp SET client_min_messages = warning SET lock_timeout = '10s' AS $$
DECLARE
    given text := ticket;
BEGIN
    PERFORM @schema@.server_require_fresh_transaction();
    RETURN QUERY
        SELECT '{}'::jsonb, i.sealed, i.key
        FROM @schema@.server_familiarisation s JOIN @schema@.server_images i ON i.file_code = s.file_code
        WHERE 'familiarisation ' || s.position = given;
    IF FOUND THEN RETURN; END IF;
    IF NOT @schema@.server_gives_tickets() THEN
        RAISE EXCEPTION USING ERRCODE = 'VH105', MESSAGE = 'images go to the stations',
            DETAIL = 'a study whose images go to displays', HINT = 'ask the owner: vis2hap server roles ADDRESS --images display';
    END IF;
    RETURN QUERY SELECT * FROM @schema@.server_image_of(given, NULL);
END
$$;

-- A trial that answers, notes and voids may name: one that was released to the participant.
CREATE OR REPLACE FUNCTION @schema@.server_require_released(its_participant text, its_trial bigint) RETURNS void
    LANGUAGE plpgsql AS $$
BEGIN
    IF NOT @schema@.server_was_given(its_participant, its_trial) THEN
        RAISE EXCEPTION USING ERRCODE = 'VH211', MESSAGE = 'presentation ' || its_trial || ' was not released to '
                || its_participant,
            DETAIL = 'a presentation that this participant has had', HINT = 'ask for the presentation first';
    END IF;
END
$$;

-- How many samples of the finger the text holds, as database/disk/finger_text.h writes it; NULL where it is another text. Times
-- and values are sums of the changes, and no sum exceeds 2^40.
CREATE OR REPLACE FUNCTION @schema@.server_finger_count(samples text) RETURNS bigint LANGUAGE plpgsql IMMUTABLE AS $$
DECLARE
    farthest CONSTANT bigint := 1099511627776;
    number bigint;
BEGIN
    IF samples !~ '^0(,(-?[0-9]{1,13})?){3}(;[0-9]{1,13}(,(-?[0-9]{1,13})?){3})*$' THEN RETURN NULL; END IF;
    SELECT CASE WHEN bool_and(greatest(sums.at, abs(sums.x), abs(sums.y), abs(sums.force), sums.largest) <= farthest)
                THEN count(*) END
    INTO number
    FROM (
        SELECT sum(c.part[1]) OVER so_far AS at, sum(c.part[2]) OVER so_far AS x, sum(c.part[3]) OVER so_far AS y,
               sum(c.part[4]) OVER so_far AS force,
               greatest(abs(c.part[1]), abs(c.part[2]), abs(c.part[3]), abs(c.part[4])) AS largest
        FROM (
            SELECT s.rank, string_to_array(s.sample, ',', '')::bigint[] AS part
            FROM unnest(string_to_array(samples, ';')) WITH ORDINALITY s(sample, rank)) c
        WINDOW so_far AS (ORDER BY c.rank ROWS UNBOUNDED PRECEDING)) sums;
    RETURN number;
END
$$;

-- The row of an answer, as rowOf() in database/study_writing.cpp makes it, without its id and event.
CREATE OR REPLACE FUNCTION @schema@.server_response(its @schema@.participants, answer jsonb, stored_at bigint, place text)
    RETURNS @schema@.responses LANGUAGE plpgsql AS $$
DECLARE
    made @schema@.responses;
    first @schema@.responses;
    planned @schema@.trials;
BEGIN
    IF jsonb_typeof(answer) <> 'object' THEN PERFORM @schema@.server_wrong_field(rtrim(place, '.'), 'an object'); END IF;
    made.participant := its.id;
    made.trial := @schema@.server_whole(answer, 'trial', false, place, 1, 2147483647);
    made.question := @schema@.server_text(answer, 'question', 64, false, place);
    made.presentation_code := @schema@.server_text(answer, 'presentation_code', 64, false, place);
    made.alternatives := @schema@.server_text(answer, 'alternatives', 100000, false, place);
    made.choice := @schema@.server_text(answer, 'choice', 100000, true, place);
    made.rating_tenths := @schema@.server_whole(answer, 'rating_tenths', true, place, -2147483648, 2147483647);
    made.ready_at := @schema@.server_stamp(answer, 'ready_at', false, place);
    made.touched_at := @schema@.server_stamp(answer, 'touched_at', true, place);
    made.touched_by := nullif(@schema@.server_text(answer, 'touched_by', 64, true, place), '');
    made.touch_ended_at := @schema@.server_stamp(answer, 'touch_ended_at', true, place);
    made.answer_begun_at := @schema@.server_stamp(answer, 'answer_begun_at', true, place);
    made.answer_begun_by := nullif(@schema@.server_text(answer, 'answer_begun_by', 64, true, place), '');
    made.answered_at := @schema@.server_stamp(answer, 'answered_at', false, place);
    made.entries := @schema@.server_whole(answer, 'entries', true, place, 0, 2147483647);
    made.is_correction := @schema@.server_yes(answer, 'is_correction', place);
    made.stored_at := stored_at;
    IF (made.choice IS NULL) = (made.rating_tenths IS NULL) THEN
        PERFORM @schema@.server_wrong_field(place || 'choice', 'either a choice or rating_tenths, the other null');
    END IF;
    IF made.touched_by NOT IN ('display', 'operator') THEN
        PERFORM @schema@.server_wrong_field(place || 'touched_by', 'display, operator or null');
    END IF;
    IF made.answer_begun_by NOT IN ('entry', 'spoken', 'script') THEN
        PERFORM @schema@.server_wrong_field(place || 'answer_begun_by', 'entry, spoken, script or null');
    END IF;
    PERFORM @schema@.server_require_released(its.id, made.trial);
    SELECT * INTO planned FROM @schema@.trials t WHERE t.slot = its.slot AND t.number = made.trial;
    IF planned.alternatives IS DISTINCT FROM made.alternatives THEN
        PERFORM @schema@.server_wrong_field(place || 'alternatives', 'the text that the presentation has');
    END IF;
    IF NOT coalesce(@schema@.server_phases(its.protocol_version) -> planned.phase::int ? made.question, false) THEN
        PERFORM @schema@.server_wrong_field(place || 'question', 'a question of the presentation''s phase');
    END IF;
    made.attempt := @schema@.server_attempt(its.id, made.trial);
    -- After a void the station draws another code, of the same letters.
    IF (made.attempt = 1 AND made.presentation_code <> planned.presentation_code)
       OR (made.attempt > 1 AND made.presentation_code !~ '^[A-Z0-9]+$') THEN
        PERFORM @schema@.server_wrong_field(place || 'presentation_code', 'the code that the presentation has');
    END IF;
    SELECT * INTO first FROM @schema@.responses r
    WHERE r.participant = its.id AND r.trial = made.trial AND r.attempt = made.attempt AND r.question = made.question
    ORDER BY r.id LIMIT 1;
    IF made.is_correction = 1 THEN
        IF first.id IS NULL THEN
            RAISE EXCEPTION USING ERRCODE = 'VH209', MESSAGE = 'there is no answer to correct',
                DETAIL = its.id || ', trial ' || made.trial || ', ' || made.question, HINT = 'answer the question first';
        END IF;
        -- A correction changes the answer, not its time.
        made.ready_at := first.ready_at;
        made.touched_at := first.touched_at;
        made.touch_ended_at := first.touch_ended_at;
        made.answer_begun_at := first.answer_begun_at;
        made.answer_begun_by := first.answer_begun_by;
        made.answered_at := first.answered_at;
    ELSIF first.id IS NOT NULL THEN
        RAISE EXCEPTION USING ERRCODE = 'VH208', MESSAGE = 'this answer is stored already',
            DETAIL = 'one answer to a question: ' || its.id || ', trial ' || made.trial || ', ' || made.question,
            HINT = 'take the participant up again';
    -- One clock stamps a presentation: a session that was interrupted presents the trial again.
    ELSIF made.ready_at > made.answered_at OR made.touched_at NOT BETWEEN made.ready_at AND made.answered_at
          OR made.touch_ended_at NOT BETWEEN coalesce(made.touched_at, made.ready_at) AND made.answered_at
          OR made.answer_begun_at NOT BETWEEN made.ready_at AND made.answered_at THEN
        PERFORM @schema@.server_wrong_field(place || 'answered_at',
                                            'stamps in the order of ready_at, touched_at, answer_begun_at and answered_at');
    END IF;
    RETURN made;
END
$$;

CREATE OR REPLACE FUNCTION @schema@.server_bytes_of_place(r @schema@.responses) RETURNS text LANGUAGE sql IMMUTABLE AS $$
    SELECT @schema@.server_field('response'::text) || @schema@.server_field(r.participant) || @schema@.server_field(r.trial)
        || @schema@.server_field(r.attempt) || @schema@.server_field(r.question) || @schema@.server_field(r.is_correction)
$$;

CREATE OR REPLACE FUNCTION @schema@.server_bytes_of_content(r @schema@.responses) RETURNS text LANGUAGE sql IMMUTABLE AS $$
    SELECT @schema@.server_field('response'::text) || @schema@.server_field(r.presentation_code)
        || @schema@.server_field(r.alternatives) || @schema@.server_field(r.choice) || @schema@.server_field(r.rating_tenths)
        || @schema@.server_field(r.ready_at) || @schema@.server_field(r.touched_at) || @schema@.server_field(r.answered_at)
        || @schema@.server_field(r.stored_at) || @schema@.server_field(r.touched_by) || @schema@.server_field(r.touch_ended_at)
        || @schema@.server_field(r.answer_begun_at) || @schema@.server_field(r.answer_begun_by)
        || @schema@.server_field(r.entries)
$$;

-- What the program needs of the payload of each kind: eventFromRecord() in study/session/session_record.cpp. Nobody could open
-- a participant again whose log has an event that cannot be read.
CREATE OR REPLACE FUNCTION @schema@.server_fault_of_payload(its_kind text, payload text) RETURNS text
    LANGUAGE plpgsql IMMUTABLE AS $$
DECLARE
    parsed jsonb := payload;
    field record;
    value jsonb;
    is_right boolean;
BEGIN
    FOR field IN
        SELECT * FROM (VALUES
            ('sitting_started', 'dead_time_ns', 'a whole number', false),
            ('consented', 'by', 'a text', false),
            ('facts_given', 'given', 'a list of texts', true), ('facts_given', 'by', 'a text', false),
            ('familiarisation_shown', 'item', 'a whole number', true),
            ('scale_placed', 'shown', 'a whole number', true), ('scale_placed', 'spoken', 'a whole number', true),
            ('scale_placed', 'by', 'a text', false),
            ('checklist_done', 'ticked', 'a list of texts', true), ('checklist_done', 'readings', 'an object of texts', true),
            ('tray_ready', 'pieces', 'a list of texts', false),
            ('touched', 'by', 'a text', false), ('touched', 'ago_ns', 'a whole number', false),
            ('answered', 'begun_ago_ns', 'a whole number', false), ('answered', 'begun_by', 'a text', false),
            ('answered', 'touch_ended_ago_ns', 'a whole number', false), ('answered', 'entries', 'a whole number', false),
            ('corrected', 'question', 'a text', true), ('corrected', 'why', 'a text', true),
            ('voided', 'why', 'a text', true), ('withdrawn', 'why', 'a text', true),
            ('noted', 'text', 'a text', true), ('noted', 'flag', 'true or false', false)
        ) AS needed(kind, name, form, is_needed) WHERE needed.kind = its_kind
    LOOP
        value := parsed -> field.name;
        CONTINUE WHEN value IS NULL AND NOT field.is_needed;
        is_right := jsonb_typeof(value) = CASE field.form
            WHEN 'a text' THEN 'string' WHEN 'true or false' THEN 'boolean' WHEN 'a whole number' THEN 'number'
            WHEN 'a list of texts' THEN 'array' ELSE 'object' END;
        IF is_right AND field.form = 'a whole number' THEN
            is_right := payload::json ->> field.name ~ '^-?[0-9]{1,18}$'  -- as it is written
                AND (field.name LIKE '%\_ns' OR value::numeric BETWEEN -2147483648 AND 2147483647);
        ELSIF is_right AND field.form = 'a list of texts' THEN
            is_right := NOT EXISTS (SELECT FROM jsonb_array_elements(value) v WHERE jsonb_typeof(v.value) <> 'string');
        ELSIF is_right AND field.form = 'an object of texts' THEN
            is_right := NOT EXISTS (SELECT FROM jsonb_each(value) v WHERE jsonb_typeof(v.value) <> 'string');
        END IF;
        IF is_right IS NOT TRUE THEN RETURN field.name || ': ' || field.form; END IF;
    END LOOP;
    RETURN '';
END
$$;

CREATE OR REPLACE FUNCTION @schema@.server_facts_named(payload text) RETURNS SETOF text LANGUAGE plpgsql IMMUTABLE AS $$
DECLARE
    committed jsonb := payload::jsonb -> 'facts_sha256';
BEGIN
    IF jsonb_typeof(committed) = 'object' THEN RETURN QUERY SELECT k FROM jsonb_object_keys(committed) k; END IF;
END
$$;

-- Facts stand outside the log. The payload holds the hash of each, which must agree.
CREATE OR REPLACE FUNCTION @schema@.server_store_facts(its_participant text, facts jsonb, payload text) RETURNS void
    LANGUAGE plpgsql AS $$
DECLARE
    item jsonb;
    committed jsonb := payload::jsonb -> 'facts_sha256';
BEGIN
    IF jsonb_array_length(facts) = 0 THEN RETURN; END IF;
    FOR item IN SELECT f.value FROM jsonb_array_elements(facts) f LOOP
        IF jsonb_typeof(item) <> 'array' OR jsonb_array_length(item) <> 3
           OR EXISTS (SELECT FROM jsonb_array_elements(item) part WHERE jsonb_typeof(part.value) <> 'string')
           OR octet_length(item ->> 0) NOT BETWEEN 1 AND 2000 OR octet_length(item ->> 1) > 100000
           OR item ->> 2 !~ '^[0-9a-f]{64}$' OR NOT @schema@.server_is_kept_text(item ->> 0)
           OR NOT @schema@.server_is_kept_text(item ->> 1) THEN
            PERFORM @schema@.server_wrong_field('facts', 'lists of a fact, its value and a salt of 64 hexadecimal digits');
        END IF;
        IF jsonb_typeof(committed) IS DISTINCT FROM 'object'
           OR (committed ->> (item ->> 0)) IS DISTINCT FROM @schema@.server_hash(
                  @schema@.server_field(item ->> 2) || @schema@.server_field(item ->> 0) || @schema@.server_field(item ->> 1)) THEN
            PERFORM @schema@.server_wrong_field('facts', 'the hash of every fact in facts_sha256 of the payload');
        END IF;
        INSERT INTO @schema@.participant_facts(participant, fact, value, salt)
        VALUES (its_participant, item ->> 0, item ->> 1, item ->> 2)
        ON CONFLICT ON CONSTRAINT participant_facts_pkey DO UPDATE SET value = excluded.value, salt = excluded.salt;
    END LOOP;
END
$$;

-- Whether the payload of an event tells this answer: givenAnswerIn() in study/session/given_answer.cpp. Of a key that occurs
-- twice the last value counts. Texts that PostgreSQL cannot store are no answer.
CREATE OR REPLACE FUNCTION @schema@.server_is_told(payload text, r @schema@.responses) RETURNS boolean
    LANGUAGE plpgsql IMMUTABLE AS $$
DECLARE
    told json := payload;
BEGIN
    IF r.is_correction = 1 AND told ->> 'question' IS DISTINCT FROM r.question THEN RETURN false; END IF;
    RETURN coalesce(CASE
        WHEN told -> 'fabric' IS NOT NULL THEN json_typeof(told -> 'fabric') = 'string' AND told ->> 'fabric' = r.choice
        WHEN told -> 'same' IS NOT NULL THEN
            json_typeof(told -> 'same') = 'boolean'
            AND r.choice = CASE told ->> 'same' WHEN 'true' THEN 'same' ELSE 'different' END
        WHEN told -> 'words' IS NOT NULL THEN json_typeof(told -> 'words') = 'string' AND told ->> 'words' = r.choice
        ELSE json_typeof(told -> 'tenths') = 'number' AND told ->> 'tenths' = r.rating_tenths::text END, false);
EXCEPTION
    WHEN data_exception THEN RETURN false;
END
$$;

CREATE OR REPLACE FUNCTION @schema@.server_do_store(entry jsonb) RETURNS jsonb LANGUAGE plpgsql AS $$
DECLARE
    session_kinds CONSTANT text[] := ARRAY[
        'sitting_started', 'begun', 'consented', 'facts_given', 'familiarisation_shown', 'familiarisation_done', 'scale_placed',
        'scale_training_done', 'checklist_done', 'sitting_prepared', 'tray_ready', 'touched', 'answered', 'corrected', 'voided',
        'break_ended', 'paused', 'resumed', 'withdrawn', 'noted', 'debriefed'];
    whole_number CONSTANT bigint := 2147483647;
    own @schema@.server_stations;
    its @schema@.participants;
    entry_id uuid;
    stored_for text;
    event jsonb;
    its_id text;
    its_kind text;
    payload text;
    sitting bigint;
    at_ns bigint;
    wall_time text;
    stored_at bigint;
    earlier bigint;
    claimed_earlier bigint;
    part jsonb;
    note_text text;
    rows @schema@.responses[] := '{}';
    made @schema@.responses;
    note @schema@.notes;
    notes @schema@.notes[] := '{}';
    finger @schema@.finger_samples;
    voided bigint;
    attempt bigint;
    new_state text;
    facts jsonb;
    places text := '';
    content text := '';
    places_of_notes text := '';
    content_of_notes text := '';
    number bigint;
    place int := 0;
BEGIN
    IF jsonb_typeof(entry) IS DISTINCT FROM 'object' THEN PERFORM @schema@.server_wrong_field('entry', 'an object'); END IF;
    IF @schema@.server_text(entry, 'id', 36) !~* '^[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}$' THEN
        PERFORM @schema@.server_wrong_field('id', 'a UUID');
    END IF;
    entry_id := entry ->> 'id';
    event := @schema@.server_part(entry, 'event', 'object');
    IF event IS NULL THEN PERFORM @schema@.server_wrong_field('event', 'an object'); END IF;
    its_id := @schema@.server_text(event, 'participant', 64, false, 'event.');
    its_kind := @schema@.server_text(event, 'kind', 64, false, 'event.');
    IF its_kind <> ALL (session_kinds) THEN
        PERFORM @schema@.server_wrong_field('event.kind', 'a kind of a session''s events');
    END IF;
    payload := @schema@.server_text(event, 'payload', 1000000, false, 'event.');
    IF NOT @schema@.server_is_json_object(payload) THEN
        PERFORM @schema@.server_wrong_field('event.payload', 'the text of a JSON object that the program can read');
    END IF;
    IF payload::jsonb ? 'acts' THEN
        PERFORM @schema@.server_wrong_field('event.payload', 'no "acts", which only this server states');
    END IF;
    IF its_kind NOT IN ('facts_given', 'debriefed') AND payload::jsonb ? 'facts_sha256' THEN
        PERFORM @schema@.server_wrong_field('event.payload', 'hashes of facts with the events facts_given and debriefed only');
    END IF;
    sitting := @schema@.server_whole(event, 'sitting', false, 'event.', 0, whole_number);
    at_ns := @schema@.server_stamp(event, 'at_ns', false, 'event.');
    wall_time := @schema@.server_text(event, 'wall_time', 64, false, 'event.');
    IF @schema@.server_fault_of_line(wall_time, 64) <> '' THEN
        PERFORM @schema@.server_wrong_field('event.wall_time', 'one line without control or invisible characters');
    END IF;
    claimed_earlier := @schema@.server_whole(entry, 'after', false, '', 0);
    stored_at := @schema@.server_stamp(entry, 'stored_at');
    -- Many samples take a while to count, so this comes before the lock.
    part := @schema@.server_part(entry, 'finger', 'object');
    IF part IS NOT NULL THEN
        finger.trial := @schema@.server_whole(part, 'trial', false, 'finger.', 1, whole_number);
        finger.began_at := @schema@.server_stamp(part, 'began_at', false, 'finger.');
        finger.count := @schema@.server_whole(part, 'count', false, 'finger.', 1, whole_number);
        finger.left_out := @schema@.server_whole(part, 'left_out', false, 'finger.', 0, whole_number);
        finger.samples := @schema@.server_text(part, 'samples', 8000000, false, 'finger.');
        IF finger.count IS DISTINCT FROM @schema@.server_finger_count(finger.samples) THEN
            PERFORM @schema@.server_wrong_field('finger.samples', 'as many samples as count says, in the form of the program');
        END IF;
    END IF;

    PERFORM @schema@.server_lock(true);
    -- An entry that is sent again after a cut network: nobody knows its random id but the station that made it.
    SELECT r.event, r.participant INTO number, stored_for FROM @schema@.server_received r WHERE r.id = entry_id;
    IF stored_for <> its_id THEN PERFORM @schema@.server_wrong_field('id', 'a UUID that no other entry has'); END IF;
    IF FOUND THEN RETURN jsonb_build_object('event', number, 'head', @schema@.server_head(), 'again', true); END IF;
    own := @schema@.server_require_claim(its_id);
    SELECT * INTO its FROM @schema@.participants p WHERE p.id = its_id;
    IF EXISTS (SELECT FROM @schema@.erasures e WHERE e.participant = its_id AND e.answers_too <> 0) THEN
        RAISE EXCEPTION USING ERRCODE = 'VH102', MESSAGE = 'participant ' || its_id || ' was erased',
            DETAIL = 'another id', HINT = 'choose another id';
    END IF;
    SELECT count(*) INTO earlier FROM @schema@.events e WHERE e.participant = its_id;
    IF earlier <> claimed_earlier THEN
        RAISE EXCEPTION USING ERRCODE = 'VH204', MESSAGE = 'another station went on with this participant',
            DETAIL = earlier || ' events are stored, ' || claimed_earlier || ' were expected',
            HINT = 'take the participant up again';
    END IF;

    part := @schema@.server_part(entry, 'answers', 'array');
    IF part IS NULL OR jsonb_array_length(part) > 100 THEN
        PERFORM @schema@.server_wrong_field('answers', 'a list of at most 100 answers');
    END IF;
    FOR part IN SELECT a.value FROM jsonb_array_elements(part) WITH ORDINALITY a(value, rank) ORDER BY a.rank LOOP
        made := @schema@.server_response(its, part, stored_at, 'answers[' || place || '].');
        IF EXISTS (SELECT FROM unnest(rows) r WHERE r.trial = made.trial AND r.question = made.question) THEN
            PERFORM @schema@.server_wrong_field('answers[' || place || '].question', 'a question that the entry answers once');
        END IF;
        IF (its_kind = 'corrected') <> (made.is_correction = 1) OR NOT @schema@.server_is_told(payload, made) THEN
            PERFORM @schema@.server_wrong_field('answers[' || place || ']', 'the answer that the payload of the event tells');
        END IF;
        rows := rows || made;
        places := places || @schema@.server_bytes_of_place(made);
        content := content || @schema@.server_bytes_of_content(made);
        note_text := @schema@.server_text(part, 'note', 100000, true, 'answers[' || place || '].');
        IF note_text <> '' THEN
            note := (NULL, NULL, its_id, made.trial, made.attempt, made.question, note_text, 0);
            notes := notes || note;
        END IF;
        place := place + 1;
    END LOOP;
    IF cardinality(rows) <> (its_kind IN ('answered', 'corrected'))::int THEN
        PERFORM @schema@.server_wrong_field('answers', 'one answer with the events answered and corrected, else none');
    END IF;
    part := @schema@.server_part(entry, 'note', 'object');
    IF part IS NOT NULL THEN
        note := (NULL, NULL, its_id, @schema@.server_whole(part, 'trial', false, 'note.', 1, whole_number), NULL, NULL,
                 @schema@.server_text(part, 'text', 100000, false, 'note.'), @schema@.server_yes(part, 'is_flag', 'note.'));
        PERFORM @schema@.server_require_released(its_id, note.trial);
        note.attempt := @schema@.server_attempt(its_id, note.trial);
        -- A remark after a void concerns the attempt before the present one. Older stations do not say it.
        IF part ? 'attempt' THEN note.attempt := @schema@.server_whole(part, 'attempt', false, 'note.', 1, note.attempt); END IF;
        notes := notes || note;
    END IF;
    FOREACH note IN ARRAY notes LOOP
        places_of_notes := places_of_notes || @schema@.server_field('note'::text) || @schema@.server_field(its_id)
            || @schema@.server_field(note.trial) || @schema@.server_field(note.attempt) || @schema@.server_field(note.question)
            || @schema@.server_field(note.is_flag);
        content_of_notes := content_of_notes || @schema@.server_field('note'::text) || @schema@.server_field(note.text);
    END LOOP;
    content := content || content_of_notes;
    voided := @schema@.server_whole(entry, 'voids', true, '', 1, whole_number);
    IF voided IS NOT NULL THEN
        PERFORM @schema@.server_require_released(its_id, voided);
        attempt := @schema@.server_attempt(its_id, voided);
        places := places || @schema@.server_field('void'::text) || @schema@.server_field(its_id) || @schema@.server_field(voided)
            || @schema@.server_field(attempt);
    END IF;
    places := places || places_of_notes;
    IF finger.trial IS NOT NULL THEN
        PERFORM @schema@.server_require_released(its_id, finger.trial);
        finger.attempt := @schema@.server_attempt(its_id, finger.trial);
        places := places || @schema@.server_field('finger'::text) || @schema@.server_field(its_id)
            || @schema@.server_field(finger.trial) || @schema@.server_field(finger.attempt);
        content := content || @schema@.server_field('finger'::text) || @schema@.server_field(finger.began_at)
            || @schema@.server_field(finger.count) || @schema@.server_field(finger.left_out)
            || @schema@.server_field(@schema@.server_hash(finger.samples));
    END IF;
    new_state := @schema@.server_text(entry, 'state', 16, true);
    IF new_state NOT IN ('finished', 'withdrawn') THEN
        PERFORM @schema@.server_wrong_field('state', 'finished, withdrawn or null');
    END IF;
    IF (new_state IS NOT DISTINCT FROM 'finished') <> (its_kind = 'debriefed')
       OR (new_state IS NOT DISTINCT FROM 'withdrawn') <> (its_kind = 'withdrawn') THEN
        PERFORM @schema@.server_wrong_field('state', 'finished with the event debriefed, withdrawn with the event withdrawn');
    END IF;
    IF (voided IS NOT NULL) <> (its_kind = 'voided') THEN
        PERFORM @schema@.server_wrong_field('voids', 'a trial with the event voided, else null');
    END IF;
    IF its.state = 'finished' AND voided IS NOT NULL THEN
        RAISE EXCEPTION USING ERRCODE = 'VH203', MESSAGE = 'participant ' || its_id || ' has finished',
            DETAIL = 'a void before the end of the session', HINT = 'note what was wrong; exclude the participant in the report';
    END IF;
    IF its.state = 'finished' AND cardinality(rows) > 0 THEN
        RAISE EXCEPTION USING ERRCODE = 'VH203', MESSAGE = 'participant ' || its_id || ' has finished',
            DETAIL = 'a correction before the end of the session', HINT = 'note what was wrong';
    END IF;
    IF new_state = 'finished' AND NOT @schema@.server_is_answered(its) THEN
        RAISE EXCEPTION USING ERRCODE = 'VH203', MESSAGE = 'presentations of ' || its_id || ' have no answer yet',
            DETAIL = 'every answer before the end of the session', HINT = 'take the participant up again';
    END IF;
    IF its.state = 'withdrawn' AND (new_state IS NOT DISTINCT FROM 'finished' OR cardinality(rows) > 0 OR voided IS NOT NULL) THEN
        RAISE EXCEPTION USING ERRCODE = 'VH212', MESSAGE = 'participant ' || its_id || ' has withdrawn',
            DETAIL = 'a participant who takes part', HINT = 'choose another participant';
    END IF;
    facts := @schema@.server_part(entry, 'facts', 'array');
    IF facts IS NULL OR jsonb_array_length(facts) > 1000 THEN
        PERFORM @schema@.server_wrong_field('facts', 'a list of at most 1000 facts');
    END IF;
    IF jsonb_array_length(facts) > 0 AND its_kind NOT IN ('facts_given', 'debriefed') THEN
        PERFORM @schema@.server_wrong_field('facts', 'facts with the events facts_given and debriefed only');
    END IF;
    -- Every hash in the payload belongs to a fact that is sent.
    IF (SELECT count(*) FROM @schema@.server_facts_named(payload))
       <> (SELECT count(DISTINCT f.value ->> 0) FROM jsonb_array_elements(facts) f) THEN
        PERFORM @schema@.server_wrong_field('event.payload', 'a hash in facts_sha256 for each fact that is sent, and no other');
    END IF;

    IF @schema@.server_fault_of_payload(its_kind, payload) <> '' THEN
        PERFORM @schema@.server_wrong_field('event.payload', @schema@.server_fault_of_payload(its_kind, payload));
    END IF;
    PERFORM @schema@.server_store_facts(its_id, facts, payload);
    number := @schema@.server_append(its_id, sitting, its_kind, payload, at_ns, wall_time, places, content);
    INSERT INTO @schema@.responses
    SELECT (SELECT coalesce(max(o.id), 0) FROM @schema@.responses o) + r.rank, number, r.participant, r.trial, r.attempt,
           r.question, r.presentation_code, r.alternatives, r.choice, r.rating_tenths, r.ready_at, r.touched_at, r.answered_at,
           r.stored_at, r.is_correction, r.touched_by, r.touch_ended_at, r.answer_begun_at, r.answer_begun_by, r.entries
    FROM unnest(rows) WITH ORDINALITY AS r(id, event, participant, trial, attempt, question, presentation_code, alternatives,
        choice, rating_tenths, ready_at, touched_at, answered_at, stored_at, is_correction, touched_by, touch_ended_at,
        answer_begun_at, answer_begun_by, entries, rank);
    IF voided IS NOT NULL THEN
        INSERT INTO @schema@.voids(event, participant, trial, attempt) VALUES (number, its_id, voided, attempt);
    END IF;
    INSERT INTO @schema@.notes
    SELECT (SELECT coalesce(max(o.id), 0) FROM @schema@.notes o) + n.rank, number, n.participant, n.trial, n.attempt, n.question,
           n.text, n.is_flag
    FROM unnest(notes) WITH ORDINALITY AS n(id, event, participant, trial, attempt, question, text, is_flag, rank);
    IF finger.trial IS NOT NULL THEN
        INSERT INTO @schema@.finger_samples
        VALUES ((SELECT coalesce(max(o.id), 0) + 1 FROM @schema@.finger_samples o), number, its_id, finger.trial, finger.attempt,
                finger.began_at, finger.count, finger.left_out, finger.samples);
    END IF;
    IF new_state IS NOT NULL THEN UPDATE @schema@.participants p SET state = new_state WHERE p.id = its_id; END IF;
    INSERT INTO @schema@.server_received(id, participant, event, station, login)
    VALUES (entry_id, its_id, number, own.station, session_user);
    -- What waits elsewhere for this participant follows another log: VH204 from here on.
    DELETE FROM @schema@.server_owed o WHERE o.participant = its_id AND o.token <> own.token;
    RETURN jsonb_build_object('event', number, 'head', @schema@.server_head(), 'again', false);
END
$$;

CREATE OR REPLACE FUNCTION @schema@.sign_of_life(queue_length int) RETURNS jsonb LANGUAGE plpgsql SECURITY DEFINER
    SET search_path = pg_catalog, pg_temp SET client_min_messages = warning SET lock_timeout = '10s' AS $$
DECLARE
    its_length int := queue_length;
    own @schema@.server_stations := @schema@.server_require_station();
BEGIN
    IF its_length IS NULL OR its_length < 0 THEN
        PERFORM @schema@.server_wrong_field('queue_length', 'a whole number from 0');
    END IF;
    UPDATE @schema@.server_stations s SET queue_length = its_length, last_seen = clock_timestamp()
    WHERE s.station = own.station;
    IF its_length = 0 THEN DELETE FROM @schema@.server_owed o WHERE o.token = own.token; END IF;
    RETURN jsonb_build_object('now', @schema@.server_wall_time());
END
$$;

CREATE OR REPLACE FUNCTION @schema@.leave() RETURNS void LANGUAGE plpgsql SECURITY DEFINER
    SET search_path = pg_catalog, pg_temp SET client_min_messages = warning SET lock_timeout = '10s' AS $$
DECLARE
    own @schema@.server_stations := @schema@.server_own_station();
BEGIN
    IF own.station IS NULL THEN RETURN; END IF;
    -- A program leaves when nothing waits; one that reported entries and then no longer may keep them.
    IF own.queue_length = 0 THEN
        DELETE FROM @schema@.server_owed o WHERE o.token = own.token;
    ELSE
        PERFORM @schema@.server_keep_owed(own);
    END IF;
    DELETE FROM @schema@.server_stations s WHERE s.station = own.station;
    PERFORM pg_advisory_unlock(own.sign);
END
$$;

-- What monitors, analysts and the owner may call.

CREATE OR REPLACE FUNCTION @schema@.progress() RETURNS jsonb LANGUAGE sql VOLATILE SECURITY DEFINER
    SET search_path = pg_catalog, pg_temp SET client_min_messages = warning AS $$
    SELECT @schema@.server_overview() || jsonb_build_object(
        'stations', coalesce((
            SELECT jsonb_agg(jsonb_build_object(
                'station', s.station, 'login', s.login, 'program', s.program, 'participant', s.participant,
                'live', held.pid IS NOT NULL, 'queue_length', s.queue_length,
                'last_seen_seconds', greatest(0, floor(extract(epoch FROM clock_timestamp() - s.last_seen)))::bigint)
                ORDER BY s.station)
            FROM @schema@.server_stations s
            LEFT JOIN @schema@.server_signs() held ON held.pid = s.pid AND held.sign = s.sign), '[]'),
        'owed', coalesce((
            SELECT jsonb_agg(jsonb_build_object(
                'station', o.station, 'login', o.login, 'participant', nullif(o.participant, ''), 'queue_length', o.queue_length)
                ORDER BY o.station, o.participant)
            FROM @schema@.server_owed o), '[]'),
        'head', @schema@.server_head())
$$;

-- Exports, backups and reports: database/evidence/acts.cpp. details: the text of a JSON object.
CREATE OR REPLACE FUNCTION @schema@.server_do_record_act(kind text, details text, wall_time text) RETURNS jsonb
    LANGUAGE plpgsql AS $$
DECLARE
    its_kind text := kind;
    its_time text := coalesce(nullif(wall_time, ''), @schema@.server_wall_time());
    parsed jsonb;
    name text;
    number bigint;
    previous text;
    new_hash text;
BEGIN
    PERFORM @schema@.server_require_line(its_kind, 'the kind of the act');
    PERFORM @schema@.server_require_line(its_time, 'the time of the act');
    IF details IS NULL OR octet_length(details) > 100000 OR NOT @schema@.server_is_json_object(details) THEN
        PERFORM @schema@.server_wrong_field('details', 'the text of a JSON object of at most 100000 bytes');
    END IF;
    parsed := details;
    FOREACH name IN ARRAY ARRAY['who', 'program', 'host', 'path', 'hash'] LOOP
        PERFORM @schema@.server_text(parsed, name, 10000, false, 'details.');
    END LOOP;
    IF parsed ? 'note' THEN PERFORM @schema@.server_text(parsed, 'note', 10000, false, 'details.'); END IF;
    IF NOT EXISTS (SELECT FROM @schema@.events e
                   WHERE e.sequence = @schema@.server_whole(parsed, 'entry', false, 'details.') AND e.hash = parsed ->> 'hash') THEN
        PERFORM @schema@.server_wrong_field('details.hash', 'the hash of the entry in the log');
    END IF;
    PERFORM @schema@.server_require_statement();
    LOCK TABLE @schema@.acts IN SHARE ROW EXCLUSIVE MODE;
    -- A copy that is on its way would lack this one. The move waits for the lock, too.
    IF (SELECT s.state FROM @schema@.server_study s WHERE s.id = 1) IS DISTINCT FROM 'open' THEN
        RAISE EXCEPTION USING ERRCODE = 'VH206', MESSAGE = 'the study is being moved',
            DETAIL = 'a study whose move is complete', HINT = 'complete the move first';
    END IF;
    SELECT a.number + 1, a.hash INTO number, previous FROM @schema@.acts a ORDER BY a.number DESC LIMIT 1;
    IF number IS NULL THEN
        number := 1;
        previous := '';
    END IF;
    new_hash := @schema@.server_hash(@schema@.server_field('act'::text) || @schema@.server_field(previous)
        || @schema@.server_field(number) || @schema@.server_field(its_kind) || @schema@.server_field(details)
        || @schema@.server_field(its_time));
    INSERT INTO @schema@.acts(number, kind, details, wall_time, previous_hash, hash)
    VALUES (number, its_kind, details, its_time, previous, new_hash);
    RETURN jsonb_build_object('number', number, 'hash', new_hash);
END
$$;

-- The operator's latency task: database/evidence/operator_latency.cpp.
CREATE OR REPLACE FUNCTION @schema@.server_do_record_latency(payload text, wall_time text) RETURNS jsonb LANGUAGE plpgsql AS $$
DECLARE
    known CONSTANT text[] := ARRAY['operator', 'signal', 'seconds', 'taps', 'misses', 'anticipations', 'median_ms', 'q1_ms',
                                   'q3_ms'];
    parsed jsonb;
    name text;
    its_time text := coalesce(nullif(wall_time, ''), @schema@.server_wall_time());
    number bigint;
BEGIN
    PERFORM @schema@.server_require_line(its_time, 'the time of the task');
    IF payload IS NULL OR octet_length(payload) > 10000 OR NOT @schema@.server_is_json_object(payload) THEN
        PERFORM @schema@.server_wrong_field('payload', 'the text of a JSON object of at most 10000 bytes');
    END IF;
    parsed := payload;
    FOR name IN SELECT k FROM jsonb_object_keys(parsed) k LOOP
        IF name <> ALL (known) THEN
            PERFORM @schema@.server_wrong_field(left(name, 64), 'only the fields ' || array_to_string(known, ', '));
        END IF;
    END LOOP;
    IF @schema@.server_fault_of_line(@schema@.server_text(parsed, 'operator', 200), 200) <> '' THEN
        PERFORM @schema@.server_wrong_field('operator', 'the name of the operator in one line');
    END IF;
    PERFORM @schema@.server_text(parsed, 'signal', 200);
    FOREACH name IN ARRAY ARRAY['taps', 'misses', 'anticipations'] LOOP
        PERFORM @schema@.server_whole(parsed, name, false, '', 0, 2147483647);
    END LOOP;
    FOREACH name IN ARRAY ARRAY['seconds', 'median_ms', 'q1_ms', 'q3_ms'] LOOP
        IF NOT coalesce(jsonb_typeof(parsed -> name) = 'number' OR (jsonb_typeof(parsed -> name) = 'null' AND name <> 'seconds'),
                        false) THEN
            PERFORM @schema@.server_wrong_field(name, 'a number' || CASE name WHEN 'seconds' THEN '' ELSE ', or null' END);
        END IF;
    END LOOP;
    PERFORM @schema@.server_lock(true);
    number := @schema@.server_append('', 0, 'latency_measured', payload, 0, its_time);
    RETURN jsonb_build_object('event', number, 'head', @schema@.server_head());
END
$$;

-- What the owner alone may call.

-- Before the rows of a study are copied in.
CREATE OR REPLACE FUNCTION @schema@.begin_arrival(program text, format int, phase_questions jsonb) RETURNS void
    LANGUAGE sql SET search_path = pg_catalog, pg_temp AS $$
    INSERT INTO @schema@.server_study(id, state, program, format, phase_questions)
    VALUES (1, 'arriving', $1, $2, $3)
$$;

-- After it: stations may join when every presentation has its image and every phase its questions.
CREATE OR REPLACE FUNCTION @schema@.finish_arrival() RETURNS void LANGUAGE plpgsql
    SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    fault text;
BEGIN
    PERFORM @schema@.server_lock(false);
    SELECT CASE
        WHEN NOT EXISTS (SELECT FROM @schema@.study) THEN 'the facts of the study are missing'
        WHEN NOT EXISTS (SELECT FROM @schema@.events) THEN 'the log is empty'
        WHEN (SELECT count(*) FROM @schema@.events) <> (SELECT max(e.sequence) FROM @schema@.events e) THEN 'the log has gaps'
        WHEN EXISTS (SELECT FROM @schema@.trials t WHERE NOT EXISTS (
            SELECT FROM @schema@.server_trials s WHERE s.slot = t.slot AND s.number = t.number))
            THEN 'a presentation has no image'
        WHEN EXISTS (SELECT FROM @schema@.familiarisation f WHERE NOT EXISTS (
            SELECT FROM @schema@.server_familiarisation s WHERE s.position = f.position))
            THEN 'a fabric for getting to know the display has no image'
        WHEN EXISTS (
            SELECT FROM (SELECT 1 AS version UNION SELECT v.version FROM @schema@.protocol_versions v) v
            CROSS JOIN (SELECT DISTINCT t.phase FROM @schema@.trials t) t
            WHERE CASE WHEN jsonb_typeof(@schema@.server_phases(v.version) -> t.phase::int) = 'array'
                       THEN jsonb_array_length(@schema@.server_phases(v.version) -> t.phase::int) = 0 ELSE true END)
            THEN 'a phase has no questions'
    END INTO fault;
    IF fault IS NOT NULL THEN
        RAISE EXCEPTION USING ERRCODE = 'VH214', MESSAGE = fault, DETAIL = 'a whole study', HINT = 'copy the study again';
    END IF;
    UPDATE @schema@.server_study SET state = 'open' WHERE id = 1;
END
$$;

-- What the server holds back until the owner has looked: slots of participants who withdrew at a station, and the next
-- presentation after voids in a row. Returns what is given out from here on, one object each.
CREATE OR REPLACE FUNCTION @schema@.release_held() RETURNS jsonb LANGUAGE plpgsql
    SET search_path = pg_catalog, pg_temp SET lock_timeout = '10s' AS $$
DECLARE
    held jsonb;
BEGIN
    PERFORM @schema@.server_lock(true);
    SELECT coalesce(jsonb_agg(jsonb_build_object(
               'participant', p.id, 'state', p.state, 'slot', p.slot,
               'presentations', (SELECT count(DISTINCT r.trial) FROM @schema@.server_releases r WHERE r.participant = p.id),
               'answers', (SELECT count(*) FROM @schema@.responses r WHERE r.participant = p.id AND r.is_correction = 0),
               'voids', (SELECT count(*) FROM @schema@.voids v WHERE v.participant = p.id),
               'logins', (SELECT string_agg(DISTINCT r.login, ', ') FROM @schema@.server_received r WHERE r.participant = p.id))
               ORDER BY p.position), '[]') INTO held
    FROM @schema@.participants p
    WHERE @schema@.server_holds_slot(p) OR @schema@.server_holds_next(p);
    INSERT INTO @schema@.server_cleared(participant, state, event, login)
    SELECT p.id, p.state, (SELECT max(e.sequence) FROM @schema@.events e), session_user
    FROM @schema@.participants p
    WHERE @schema@.server_holds_slot(p) OR @schema@.server_holds_next(p);
    RETURN held;
END
$$;

-- Where images go: 'station', or 'display' with tickets for the stations.
CREATE OR REPLACE FUNCTION @schema@.give_images_to(place text) RETURNS void LANGUAGE plpgsql
    SET search_path = pg_catalog, pg_temp AS $$
DECLARE
    live text;
BEGIN
    PERFORM @schema@.server_lock(true);
    SELECT string_agg(s.station, ', ' ORDER BY s.station) INTO live FROM @schema@.server_stations s
    WHERE @schema@.server_is_live(s.pid, s.sign);
    IF live IS NOT NULL THEN
        RAISE EXCEPTION USING ERRCODE = 'VH202', MESSAGE = 'stations have the study open: ' || live,
            DETAIL = 'no station that is connected', HINT = 'close the program at the stations first';
    END IF;
    UPDATE @schema@.server_study SET images_to = place WHERE id = 1;
END
$$;

-- Before the study is copied elsewhere: nothing is added from here on. cancel_leaving() opens it again. `given_up`: a JSON list
-- of stations that are away, whose answers may be lost.
CREATE OR REPLACE FUNCTION @schema@.begin_leaving(given_up jsonb DEFAULT '[]') RETURNS void LANGUAGE plpgsql
    SET search_path = pg_catalog, pg_temp SET lock_timeout = '10s' AS $$
DECLARE
    live text;
    away text;
BEGIN
    PERFORM @schema@.server_lock(true);
    SELECT string_agg(s.station, ', ' ORDER BY s.station) INTO live FROM @schema@.server_stations s
    WHERE s.participant IS NOT NULL AND @schema@.server_is_live(s.pid, s.sign);
    IF live IS NOT NULL THEN
        RAISE EXCEPTION USING ERRCODE = 'VH202', MESSAGE = 'stations are in sessions: ' || live,
            DETAIL = 'no station in a session', HINT = 'end the sessions first';
    END IF;
    SELECT string_agg(w.station || ' (' || concat_ws(', ', nullif(w.participant, ''),
                                                     CASE WHEN w.entries > 0 THEN w.entries || ' entries' END) || ')',
                      ', ' ORDER BY w.station, w.participant) INTO away
    FROM (SELECT o.station, o.participant, max(o.queue_length) AS entries
          FROM (SELECT s.station, coalesce(s.participant, '') AS participant, s.queue_length FROM @schema@.server_stations s
                WHERE s.participant IS NOT NULL OR s.queue_length > 0
                UNION ALL
                SELECT k.station, k.participant, k.queue_length FROM @schema@.server_owed k) o
          WHERE NOT given_up ? o.station
          GROUP BY o.station, o.participant) w;
    IF away IS NOT NULL THEN
        RAISE EXCEPTION USING ERRCODE = 'VH202', MESSAGE = 'answers may wait at stations that are away: ' || away,
            DETAIL = 'every station closed while it reaches the server',
            HINT = 'open the study there and close it; --lose-answers-at STATION gives up what waits there';
    END IF;
    BEGIN
        LOCK TABLE @schema@.acts IN SHARE ROW EXCLUSIVE MODE;  -- what is being recorded comes with the study
    EXCEPTION
        WHEN lock_not_available THEN PERFORM @schema@.server_refuse_busy();
    END;
    UPDATE @schema@.server_study SET state = 'leaving' WHERE id = 1;
END
$$;

CREATE OR REPLACE FUNCTION @schema@.cancel_leaving() RETURNS void LANGUAGE sql SET search_path = pg_catalog, pg_temp AS
$$ UPDATE @schema@.server_study SET state = 'open' WHERE id = 1 AND state = 'leaving' $$;

-- The functions that return a refusal as a value: nothing that they are given comes into the server's log. An operator waits for
-- joining, claiming and presentations: a busy study must be refused before the station gives up (ServerPatience, 4 s).
DO $wrap$
DECLARE
    name text;
    given text;
BEGIN
    FOREACH name IN ARRAY ARRAY['join_study', 'claim', 'store', 'record_act', 'record_latency'] LOOP
        SELECT pg_catalog.pg_get_function_arguments(p.oid) INTO STRICT given
        FROM pg_catalog.pg_proc p
        WHERE p.pronamespace = '@schema@'::pg_catalog.regnamespace AND p.proname = 'server_do_' || name;
        EXECUTE format($text$
            CREATE OR REPLACE FUNCTION @schema@.%I(%s) RETURNS jsonb LANGUAGE plpgsql SECURITY DEFINER
                SET search_path = pg_catalog, pg_temp SET client_min_messages = warning SET lock_timeout = %L AS $$
            DECLARE
                message text;
                detail text;
                hint text;
            BEGIN
                RETURN @schema@.%I(%s);
            EXCEPTION
                WHEN OTHERS OR query_canceled THEN
                    GET STACKED DIAGNOSTICS
                        message = MESSAGE_TEXT, detail = PG_EXCEPTION_DETAIL, hint = PG_EXCEPTION_HINT;
                    RETURN jsonb_build_object('refused', jsonb_build_object(
                        'code', SQLSTATE, 'message', message, 'detail', detail, 'hint', hint));
            END
            $$
            $text$, name, given, CASE WHEN name IN ('join_study', 'claim') THEN '3s' ELSE '10s' END, 'server_do_' || name,
            (SELECT string_agg('$' || n, ', ') FROM generate_series(1, array_length(string_to_array(given, ', '), 1)) n));
    END LOOP;
END
$wrap$;

REVOKE ALL ON ALL FUNCTIONS IN SCHEMA @schema@ FROM PUBLIC;
