var i={channel:{inclination_deg:40,incline_length_m:1,runout_length_m:2},flow:{volume_m3:.01},bodies:[{shape:{cube:{side_m:.04}}}]};export{i as a};
