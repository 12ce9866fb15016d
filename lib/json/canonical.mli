(** The texts of JSON, all in one way. *)

include module type of struct
  include Dolphin_json_text.Canonical
end
