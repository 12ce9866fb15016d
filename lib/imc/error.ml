type fault =
  | Overrun
  | Leftover of int
  | Unknown_message of int
  | Misplaced of { id : int; expected : string }
  | Too_deep

type decode =
  | Too_short of int
  | Not_imc of int
  | Truncated of { stated : int; present : int }
  | Surplus of int
  | Bad_checksum of { stated : int; computed : int }
  | Bad_payload of { id : int; at : int; fault : fault }

type encode =
  | Out_of_range of { field : string; value : int }
  | Too_long of { field : string; length : int }
  | Nested_too_deep of { field : string }
  | Too_large of { id : int; size : int }

let max_depth = 16

let label = function
  | Too_short _ -> "too short"
  | Not_imc _ -> "not IMC"
  | Truncated _ -> "truncated"
  | Surplus _ -> "surplus bytes"
  | Bad_checksum _ -> "bad checksum"
  | Bad_payload { fault = Overrun; _ } -> "field past the end"
  | Bad_payload { fault = Leftover _; _ } -> "bytes left over"
  | Bad_payload { fault = Unknown_message _; _ } -> "unknown inline message"
  | Bad_payload { fault = Misplaced _; _ } -> "misplaced inline message"
  | Bad_payload { fault = Too_deep; _ } -> "nested too deep"

let pp_fault ppf = function
  | Overrun -> Fmt.string ppf "a field reaches past the end"
  | Leftover n -> Fmt.pf ppf "%d bytes follow the last field" n
  | Unknown_message id -> Fmt.pf ppf "unknown message %d" id
  | Misplaced { id; expected } -> Fmt.pf ppf "message %d stands where %s is expected" id expected
  | Too_deep -> Fmt.pf ppf "more than %d messages within messages" max_depth

let pp_decode ppf = function
  | Too_short length -> Fmt.pf ppf "%d bytes, too few for a packet" length
  | Not_imc sync -> Fmt.pf ppf "begins with %04x, not with 54fe or fe54" sync
  | Truncated { stated; present } -> Fmt.pf ppf "%d bytes of %d" present stated
  | Surplus n -> Fmt.pf ppf "%d bytes follow the packet" n
  | Bad_checksum { stated; computed } -> Fmt.pf ppf "checksum %04x, computed %04x" stated computed
  | Bad_payload { id; at; fault } -> Fmt.pf ppf "message %d, byte %d: %a" id at pp_fault fault

let pp_encode ppf = function
  | Out_of_range { field; value } -> Fmt.pf ppf "%s: %d is out of range" field value
  | Too_long { field; length } -> Fmt.pf ppf "%s: length %d, more than 65535" field length
  | Nested_too_deep { field } ->
    Fmt.pf ppf "%s: more than %d messages within messages" field max_depth
  | Too_large { id; size } -> Fmt.pf ppf "message %d: %d bytes, more than 65535" id size
