(** Whether texts are UTF-8. *)

include module type of struct
  include Dolphin_json_text.Utf8
end
