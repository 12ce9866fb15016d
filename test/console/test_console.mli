(** The server of [dolphin console]: what is asked rightly is done, what is asked wrongly changes nothing. *)
