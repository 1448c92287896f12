-- The groups of a study's logins. They cannot log in; a lab grants them to logins of its own, one for each station. Run as often
-- as wanted.

DO $$
DECLARE
    name text;
BEGIN
    FOREACH name IN ARRAY ARRAY['@prefix@_experimenter', '@prefix@_monitor', '@prefix@_analyst', '@prefix@_display'] LOOP
        IF NOT EXISTS (SELECT FROM pg_catalog.pg_roles r WHERE r.rolname = name) THEN
            EXECUTE format('CREATE ROLE %I NOLOGIN', name);
        END IF;
    END LOOP;
EXCEPTION
    WHEN insufficient_privilege THEN
        RAISE EXCEPTION USING ERRCODE = 'VH301', MESSAGE = 'your login cannot make the groups of the study',
            DETAIL = 'a login with CREATEROLE', HINT = 'ask the administrator of the server';
END
$$;

REVOKE ALL ON SCHEMA @schema@ FROM PUBLIC;
REVOKE ALL ON ALL TABLES IN SCHEMA @schema@ FROM PUBLIC, "@prefix@_experimenter", "@prefix@_monitor", "@prefix@_analyst", "@prefix@_display";
REVOKE ALL ON ALL SEQUENCES IN SCHEMA @schema@ FROM PUBLIC, "@prefix@_experimenter", "@prefix@_monitor", "@prefix@_analyst", "@prefix@_display";
REVOKE ALL ON ALL FUNCTIONS IN SCHEMA @schema@ FROM PUBLIC, "@prefix@_experimenter", "@prefix@_monitor", "@prefix@_analyst", "@prefix@_display";
REVOKE ALL ON SCHEMA @schema@ FROM "@prefix@_experimenter", "@prefix@_monitor", "@prefix@_analyst", "@prefix@_display";

GRANT USAGE ON SCHEMA @schema@ TO "@prefix@_experimenter", "@prefix@_monitor", "@prefix@_analyst", "@prefix@_display";

GRANT EXECUTE ON FUNCTION
    @schema@.join_study(text, text, text), @schema@.overview(), @schema@.claim(text, text), @schema@.presentation(int),
    @schema@.presented_image(text), @schema@.familiarisation_image(int), @schema@.store(jsonb), @schema@.sign_of_life(int),
    @schema@.leave(), @schema@.record_latency(text, text)
    TO "@prefix@_experimenter";

GRANT EXECUTE ON FUNCTION @schema@.released_image(text) TO "@prefix@_display";

GRANT EXECUTE ON FUNCTION @schema@.progress() TO "@prefix@_monitor", "@prefix@_analyst";

GRANT EXECUTE ON FUNCTION @schema@.record_act(text, text, text) TO "@prefix@_analyst";
GRANT SELECT ON
    @schema@.study, @schema@.fabrics, @schema@.stimuli, @schema@.slots, @schema@.trials, @schema@.participants, @schema@.events,
    @schema@.responses, @schema@.voids, @schema@.notes, @schema@.finger_samples, @schema@.unblindings, @schema@.swatches,
    @schema@.familiarisation, @schema@.protocol_versions, @schema@.erasures, @schema@.acts
    TO "@prefix@_analyst";
