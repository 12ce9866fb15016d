(** Positions as people and charts write them. *)

val of_string : string -> (Position.t, string) result
(** [of_string text] is the position at height 0 that [text] gives, or what is wrong with [text]:

    - degrees, minutes and seconds, the last of which may have a fraction: [41°11.1'N 8°42.4'W], [41° 11' 6" N, 8° 42'
      24" W], [N 41 11.1 W 8 42.4], [41d11'N 8d42'W]. Seconds may be two apostrophes. The longitude may come first;
    - degrees with signs: [41.185, -8.7066], the latitude first;
    - a grid position of {!Utm}: [29T 524587 4559400] with the letter of the band, [29 north 524587 4559400] or [29n
      524587 4559400] with the half of the globe, [south] or [s] being the other. The letter has to be that of the
      metres: [33S] is not the south. *)
